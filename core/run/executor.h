// Runs a graph over the frames of a source into a sink. On more than one thread, and where memory has room for it,
// reading the next frame and writing the last overlap with filtering.
#pragma once

#include "core/graph/graph.h"
#include "core/run/tap_counter.h"
#include "core/run/trace.h"
#include "core/sequence/frame_source.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace quell {

// Takes the graph's outputs, in the order of Graph::outputs.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  // May run on another thread while the next frame is filtered; one call at a time, in the order of the frames.
  virtual void write(std::int64_t frame, std::span<const quell_image> outputs) = 0;
  // Before a frame is written that has no past.
  virtual void history_begins(std::int64_t /*frame*/) {}
};

struct Progress {
  std::int64_t frame;       // just filtered
  std::size_t done, total;  // frames
};

// What filtering one frame took, seconds.
struct FrameTimes {
  std::int64_t frame;
  double wall, cpu;               // `cpu` is the process's, with what overlapped
  std::span<const double> nodes;  // wall, in order; 0 for weight nodes, which run inside of others
  std::span<const double> busy;   // the same, summed over the threads that worked on each
};

struct RunOptions {
  int threads = 0;                               // 0: every core that the process may use
  int band_rows = 0;                             // 0: chosen per node
  bool overlap = true;                           // false: reads, filters and writes one after the other, to be timed
  std::size_t max_memory = 0;                    // bytes for images, kept to by less overlap; 0: no limit
  std::filesystem::path load_state, save_state;  // empty: none
  std::filesystem::path save_cancelled;          // the same when `cancel` ends the run, behind the last frame written
  const std::atomic<bool>* cancel = nullptr;
  std::function<void(const Progress&)> progress;
  std::function<void(const FrameTimes&)> frame_times;
  Trace* trace = nullptr;
  TapCounter* taps = nullptr;  // with room for each node
};

struct NodeTime {
  std::string name, type;
  double wall = 0;  // seconds, all frames
};

struct RunReport {
  std::size_t frames = 0;
  int threads = 0;
  double wall = 0;                                        // seconds, all
  double read_wall = 0, filter_wall = 0, write_wall = 0;  // from begin to end; they overlap
  double read_cpu = 0, filter_cpu = 0, write_cpu = 0;
  int frames_in_flight = 0;           // being read, filtered and written at once; the least of all plans
  std::size_t plan_bytes = 0;         // images of the largest plan
  std::size_t wanted_bytes = 0;       // what more frames in flight would have taken, where max_memory forbade them
  std::size_t resets = 0;             // frames that began without history
  std::vector<std::int64_t> resized;  // frames whose size differs from that of the frame before
  std::vector<NodeTime> nodes;        // in order
};

// Throws Error. What was written before an error stays; a frame is never half written. Of several errors at once the
// one is thrown that a run without overlap would have met.
RunReport run_graph(const Graph&, FrameSource&, FrameSink&, const RunOptions&);

}  // namespace quell
