// A JSON schema of graph files, with which an editor completes and checks them while they are written.
#pragma once

#include "core/plugin/registry.h"

#include <string>

namespace quell {

// Draft 7, as text. It knows the node types of the registry, which opens every library.
std::string graph_schema(Registry&);

}  // namespace quell
