// Values from JSON into the parameters of a node, checked against its table.
#pragma once

#include "core/graph/library.h"
#include "core/plugin/node_type.h"

#include <string>
#include <vector>

namespace quell {

// What is wrong with a value; no text when nothing is.
struct ParamProblem {
  std::string text;
  std::vector<std::string> notes;
};

// Sets a parameter. A path is taken as it is from a command line; a graph file may only name "quell:…" (`trusted` is
// false).
ParamProblem assign(Instance&, int param, const Json& value, bool trusted, const Library&);

}  // namespace quell
