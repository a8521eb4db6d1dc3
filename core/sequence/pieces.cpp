// Pieces as tasks of TBB.
#include "core/sequence/pieces.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <exception>
#include <mutex>

#ifdef QUELL_TELL_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace quell {

namespace {

// What one thread did before give() comes before what another does after take(). TBB sees to that, but ThreadSanitizer
// does not look into TBB, and so it is told.
class HandOver {
 public:
#ifdef QUELL_TELL_THREAD_SANITIZER
  void give() { __tsan_release(this); }
  void take() { __tsan_acquire(this); }
#else
  void give() {}
  void take() {}
#endif
};

}  // namespace

void in_pieces(int count, const std::function<void(int)>& piece) {
  std::mutex mutex;
  std::exception_ptr failure;
  std::atomic<int> failed{count};
  HandOver begin, end;
  begin.give();
  tbb::parallel_for(
      tbb::blocked_range<int>(0, count, 1),
      [&](const auto& range) {
        begin.take();
        for (int i = range.begin(); i < range.end() && i < failed.load(std::memory_order_relaxed); ++i) {
          try {
            piece(i);
          } catch (...) {
            const std::scoped_lock lock(mutex);
            if (i < failed) failed = i, failure = std::current_exception();
          }
        }
        end.give();
      },
      tbb::simple_partitioner());
  end.take();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace quell
