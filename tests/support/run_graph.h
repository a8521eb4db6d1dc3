// Runs a graph written in a test over one frame of images.
#pragma once

#include "core/image/image.h"

#include <map>
#include <string>

namespace quell::test {

struct GraphImage {
  int type;  // quell_type
  const Image* image;
};

// Outputs by name. Parts are the shipped ones ("quell:parts/…"). Throws what the graph or the run report.
std::map<std::string, Image> run_graph_text(const std::string& text, const std::map<std::string, GraphImage>& inputs);

}  // namespace quell::test
