// Nodes run band by band on the host's threads.
#include "core/run/workers.h"

#include "core/report/error.h"
#include "core/run/cores.h"
#include "core/sequence/pieces.h"

#include <fmt/format.h>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include <algorithm>

namespace quell {

namespace {

// Denormal weights cost an à-trous level 17 %; they are flushed while a band runs, and the thread is left as it was.
class FlushDenormals {
#if defined(__SSE__)
 public:
  FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040u); }
  ~FlushDenormals() { _mm_setcsr(before_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned before_;
#endif
};

}  // namespace

Workers::Workers(int threads, const std::atomic<bool>* cancel, Trace* trace)
    : threads_(threads > 0 ? threads : usable_cores()),
      allowed_(tbb::global_control::max_allowed_parallelism, std::size_t(threads_)),
      arena_(threads_),
      cancel_(cancel),
      trace_(trace) {}

void Workers::run(int height, int band_rows, const std::function<void(int thread, int y0, int y1)>& rows) {
  const int bands = (height + band_rows - 1) / band_rows;
  const auto run_band = [&](int band) {
    if (cancel_ && cancel_->load(std::memory_order_relaxed)) return;
    const FlushDenormals flush;
    const int thread = threads_ == 1 || bands == 1 ? 0 : tbb::this_task_arena::current_thread_index();
    rows(thread, band * band_rows, std::min(height, (band + 1) * band_rows));
  };
  if (threads_ == 1 || bands == 1) {
    for (int band = 0; band < bands; ++band) run_band(band);
  } else {
    arena_.execute([&] { in_pieces(bands, run_band); });
  }
  if (cancel_ && cancel_->load()) throw Error(Exit::interrupted, "interrupted");
}

void Workers::run(const GraphNode& node, const void* resource, const quell_tile& tile) const {
  quell_error error{};
  const Trace::Span span(trace_, {node.name, node.type().name(), tile.frame, tile.y0, tile.y1});
  if (node.type().table().run(node.instance.data(), resource, &tile, &error))
    throw Error(Exit::plugin, fmt::format("{} ({}), frame {}, rows {}-{}: {}", node.name, node.type().name(),
                                          tile.frame, tile.y0, tile.y1 - 1, error.text));
}

}  // namespace quell
