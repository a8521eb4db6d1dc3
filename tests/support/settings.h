// The choices that a node offers, each by itself; other parameters at their defaults.
#pragma once

#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <string>

namespace quell::test {

struct Setting {
  std::string param, choice;  // "" for the node as it is
  bool operator==(const Setting&) const = default;
};

inline Node node_of(std::string_view type, const Setting& setting) {
  Node node(type);
  if (!setting.param.empty()) node.set(setting.param, setting.choice);
  return node;
}

template <class Check>
void each_setting(const NodeType& type, Check check) {
  const auto checked = [&](const Setting& setting) {
    SCOPED_TRACE(setting.param + " " + setting.choice);
    check(setting);
  };
  checked({});
  for (const auto& p : type.params())
    for (int c = 0; p.kind == QUELL_CHOICE && c < p.choice_count; ++c) checked({p.name, p.choices[c]});
}

}  // namespace quell::test
