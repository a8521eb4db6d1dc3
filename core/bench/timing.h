// How long a graph takes: each node of each frame, and what its time and its images say about it.
#pragma once

#include "core/graph/graph.h"
#include "core/run/executor.h"
#include "core/run/plan.h"
#include "core/sequence/frame_source.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace quell {

// Of a number measured once a frame. Quartiles are interpolated between the two nearest ranks.
struct Spread {
  double median = 0, minimum = 0, lower = 0, upper = 0;  // 0.5, 0, 0.25 and 0.75 of the frames lie below
  double quartiles_apart() const { return upper - lower; }
};
Spread spread_of(std::vector<double>);

struct NodeTiming {
  std::string name, type;
  Spread ms;              // wall
  std::size_t bytes = 0;  // see traffic()
  std::size_t pixels = 0;
  std::uint64_t taps = 0;  // of all pixels of one frame, by TapCounter; 0: not heard

  double gigabytes_per_second() const { return ms.median > 0 ? double(bytes) / ms.median * 1e-6 : 0; }
  double megapixels_per_second() const { return ms.median > 0 ? double(pixels) / ms.median * 1e-3 : 0; }
  double megataps_per_second() const { return ms.median > 0 ? double(taps) / ms.median * 1e-3 : 0; }
};

struct Timing {
  std::string graph, fingerprint;
  std::string input;  // "synthetic", or the sequence
  int width = 0, height = 0;
  int frames = 0, warmup = 0;  // measured; run before and forgotten
  int threads = 0;
  std::string simd;                             // that kernels ran with; filled by the caller, as is `input`
  std::size_t resets = 0;                       // frames that began without history, of all
  Spread ms, cpu_ms;                            // filtering a frame: wall, and the process's CPU
  double read_ms = 0;                           // mean a frame; no part of `ms`
  std::size_t image_bytes = 0, peak_bytes = 0;  // of the plan; of the process, with the input and the program
  std::vector<NodeTiming> nodes;                // in order; weight nodes run inside of others
};

// Bytes that a node has to move at least: each distinct image that it or its weight nodes read, and each that it
// writes, once; width · height · channels · 4 each. Tables and values count the same way. What neighbours share is
// taken to come from cache.
std::size_t traffic(const Plan&, std::size_t node);

// Runs all frames of the source, reading apart from filtering, and throws the images away. The first `warmup` frames
// do not count; the taps are counted in the last of these, where there are any. Throws Error.
Timing measure(const Graph&, FrameSource&, RunOptions, int warmup);

// As JSON, and back. The text comes from the file `path`; throws Error(Exit::input) when it is no measurement.
std::string timing_json(const Timing&);
Timing parse_timing(const std::string& path, const std::string& text);

}  // namespace quell
