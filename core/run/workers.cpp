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

void Workers::run(const GraphNode& node, const void* resource, quell_tile tile, int tiled, int band_rows) {
  const int width = tile.out[tiled].width, height = tile.out[tiled].height;
  const int bands = (height + band_rows - 1) / band_rows;
  const auto run_band = [&](int band) {
    if (cancel_ && cancel_->load(std::memory_order_relaxed)) return;
    const FlushDenormals flush;
    quell_tile t = tile;
    t.x0 = 0, t.x1 = width;
    t.y0 = band * band_rows, t.y1 = std::min(height, t.y0 + band_rows);
    quell_error error{};
    const Trace::Span span(trace_, {node.name, node.type().name(), tile.frame, t.y0, t.y1});
    if (node.type().table().run(node.instance.data(), resource, &t, &error) != 0)
      throw Error(Exit::plugin, fmt::format("{} ({}), frame {}, rows {}-{}: {}", node.name, node.type().name(),
                                            tile.frame, t.y0, t.y1 - 1, error.text));
  };
  if (threads_ == 1 || bands == 1) {
    for (int band = 0; band < bands; ++band) run_band(band);
  } else {
    arena_.execute([&] { in_pieces(bands, run_band); });
  }
  if (cancel_ && cancel_->load()) throw Error(Exit::interrupted, "interrupted");
}

}  // namespace quell
