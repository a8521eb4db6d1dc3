// What a picture says of how it was made: core/run/provenance.h read back.
#pragma once

#include "core/run/provenance.h"
#include "core/sequence/image_writer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace quell {

struct Recorded {
  std::string version, simd, plugins, graph, fingerprint, sequence;
  std::string missing = "error";
  std::int64_t first = 0, frame = 0;  // frames of its history, and itself
  std::vector<std::string> files;     // values of --set
  Texts inputs;                       // hash of each file of this frame
  std::vector<std::string> history;   // of each earlier frame
  std::string state, state_hash;      // the saved state that its history goes on from; "": none
  // Of the output: its name, what a tap reads, and how it was written.
  std::string output, tap;
  WriteOptions options;
};

// Throws Error(Exit::input) when the image cannot be read, and Error(Exit::usage) when it says nothing, or nonsense.
Recorded read_recorded(const std::string& path);

}  // namespace quell
