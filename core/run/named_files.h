// Files that parameters of nodes name.
#pragma once

#include "core/plugin/node_type.h"

#include <map>
#include <string>

namespace quell {

// The hash (core/sequence/file_hash.h) of each file that a parameter of the node names, by "node.parameter".
std::map<std::string, std::string> named_files(const std::string& node, const Instance&);

}  // namespace quell
