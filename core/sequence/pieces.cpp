// Pieces as tasks of TBB.
#include "core/sequence/pieces.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <exception>
#include <mutex>

namespace quell {

void in_pieces(int count, const std::function<void(int)>& piece) {
  std::mutex mutex;
  std::exception_ptr failure;
  std::atomic<int> failed{count};
  tbb::parallel_for(
      tbb::blocked_range<int>(0, count, 1),
      [&](const auto& range) {
        for (int i = range.begin(); i < range.end() && i < failed.load(std::memory_order_relaxed); ++i) {
          try {
            piece(i);
          } catch (...) {
            const std::scoped_lock lock(mutex);
            if (i < failed) failed = i, failure = std::current_exception();
          }
        }
      },
      tbb::simple_partitioner());
  if (failure) std::rethrow_exception(failure);
}

}  // namespace quell
