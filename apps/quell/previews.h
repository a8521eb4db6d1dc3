// --preview: which picture each output gets.
#pragma once

#include "apps/quell/command.h"

#include "core/graph/graph.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace quell {

struct PreviewOptions {
  bool wanted = false;
  std::string graph;             // of radiance, in place of previews/radiance.json
  std::vector<std::string> set;  // of its parameters
  void add_to(CLI::App&);
};

// Appends a preview for each output whose type has one: the installed graph previews/<type>.json. What is wrong with
// the graph for radiance is left with the commander; throws Error(Exit::usage) when it is no preview.
void add_previews(Graph&, const PreviewOptions&, Commander&);

}  // namespace quell
