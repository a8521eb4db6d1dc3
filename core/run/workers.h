// The host's threads: one arena whose workers flush denormal numbers, on which nodes are run band by band.
#pragma once

#include "core/graph/graph.h"
#include "core/run/trace.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstdint>
#include <functional>

namespace quell {

class Workers {
 public:
  // threads <= 0: one for each of usable_cores(). Bands become events of the trace.
  explicit Workers(int threads, const std::atomic<bool>* cancel = nullptr, Trace* trace = nullptr);
  int threads() const { return threads_; }

  // Calls f on one of the threads: what it starts by TBB runs on all of them, and on no other.
  template <class F>
  auto inside(F f) {
    return arena_.execute(f);
  }

  // Calls rows(thread, y0, y1) for bands of all rows up to `height`, thread in [0, threads()). Throws
  // Error(Exit::plugin) of the first band that threw one, Error(Exit::interrupted) when the run was cancelled.
  void run(int height, int band_rows, const std::function<void(int thread, int y0, int y1)>& rows);
  // A node on one tile, within that. Throws Error(Exit::plugin) with node, frame and rows when it fails.
  void run(const GraphNode&, const void* resource, const quell_tile&) const;

 private:
  int threads_;
  tbb::global_control allowed_;  // as many as were asked for, even beyond the cores
  tbb::task_arena arena_;
  const std::atomic<bool>* cancel_;
  Trace* trace_;
};

}  // namespace quell
