// Node types that a test declares for itself, without a library.
#pragma once

#include "core/plugin/registry.h"

#include <quell/node.h>

namespace quell::test {

// Whether the registry takes T as a node type of this name. Once for each T.
template <class T>
bool add_type(Registry& registry, const char* name) {
  static const NodeTable<T> type(name);
  static const quell_node* const nodes[] = {type.node()};
  static const quell_plugin_table table{QUELL_MAGIC, QUELL_ABI_MAJOR, QUELL_ABI_MINOR, sizeof(quell_plugin_table),
                                        1,           nodes,           "1.0",           "test"};
  registry.add_static(&table);
  return registry.problems().empty();
}

}  // namespace quell::test
