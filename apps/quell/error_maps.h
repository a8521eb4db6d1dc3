// Error images of a comparison: what their files are called and what each says of how it was made.
#pragma once

#include "apps/quell/pictures.h"

#include "core/graph/graph.h"
#include "core/run/provenance.h"
#include "core/sequence/frame_pattern.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace quell {

class ErrorMaps {
 public:
  // Go to `folder`; "": there are none. Throws Error(Exit::usage) when those of two pictures would be one.
  ErrorMaps(std::string folder, const std::vector<Pictures>&);

  bool wanted() const { return !folder_.empty(); }
  // Adds what a metric finds in a picture, which is the graph's only output. Gives its index.
  std::size_t add(std::size_t picture, const std::string& metric, Graph);
  // Plain paths of all files of a frame.
  std::vector<std::string> files(std::int64_t frame) const;

  // The run that they come from, before it starts.
  void begin(FrameSource&, const FileLog&, const Provenance::Run&);
  void history_begins(std::int64_t frame);
  // Before the maps of a frame are written.
  void begin_frame(std::int64_t frame);
  // As EXR, or for the eye as PNG where the output shows another.
  void write(std::size_t map, std::int64_t frame, const quell_image&, const GraphOutput&) const;

 private:
  struct Map {
    Graph graph;  // makes it and nothing else
    FramePattern exr, png;
    std::optional<Provenance> provenance = {};
    Texts texts = {};  // of the current frame
  };

  std::string folder_;
  std::vector<std::string> stems_;  // by picture
  std::vector<Map> maps_;
};

}  // namespace quell
