// The node types of the folder QUELL_TEST_PLUGINS, where there are some.
#pragma once

#include "core/plugin/registry.h"

#include <cstdlib>

namespace quell::fuzz {

inline Registry& registry() {
  static Registry& made = []() -> Registry& {
    const char* folder = std::getenv("QUELL_TEST_PLUGINS");
    auto* all = new Registry({folder ? folder : "."});
    all->all();
    return *all;
  }();
  return made;
}

}  // namespace quell::fuzz
