// Pieces as tasks of TBB.
#include "core/sequence/pieces.h"

#include "core/sequence/job_time.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

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
  JobTime* const job = ThreadTime::job();
  const ThreadTime waiting(nullptr);
  begin.give();
  tbb::parallel_for(
      tbb::blocked_range<int>(0, count, 1),
      [&](const auto& range) {
        begin.take();
        for (int i = range.begin(); i < range.end() && i < failed.load(std::memory_order_relaxed); ++i) {
          try {
            const ThreadTime working(job);
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

struct Background::Task {
  tbb::task_group group;
  HandOver begin, end;
  std::exception_ptr failure;
};

Background::Background() : task_(std::make_unique<Task>()) {}
Background::~Background() { finish(); }

void Background::start(std::function<void()> job) {
  wait();
  started_ = true;
  task_->begin.give();
  task_->group.run([task = task_.get(), job = std::move(job)] {
    task->begin.take();
    try {
      job();
    } catch (...) {
      task->failure = std::current_exception();
    }
    task->end.give();
  });
}

void Background::wait() {
  finish();
  if (task_->failure) std::rethrow_exception(std::exchange(task_->failure, nullptr));
}

void Background::finish() {
  task_->group.wait();
  task_->end.take();
  started_ = false;
}

}  // namespace quell
