// How long jobs on files take, and how much work they are, whatever threads do it.
#pragma once

#include <atomic>
#include <cstdint>

namespace quell {

// Of all jobs of a kind.
struct JobTime {
  std::atomic<std::int64_t> wall{0}, cpu{0};  // nanoseconds
};

// The CPU time of this thread, while this lives, is a job's: null, nobody's. What is measured within another such time
// is not the outer one's, for a thread that waits for its pieces may be given any other work.
class ThreadTime {
 public:
  explicit ThreadTime(JobTime* job);
  ~ThreadTime();
  ThreadTime(const ThreadTime&) = delete;
  ThreadTime& operator=(const ThreadTime&) = delete;

  // The job that this thread works for.
  static JobTime* job();

 private:
  void charge(std::int64_t now);

  JobTime* job_;
  ThreadTime* outer_;
  std::int64_t since_ = 0;
};

// From its making to its end the calling thread does a job.
class JobSpan {
 public:
  explicit JobSpan(JobTime& job);
  ~JobSpan();

 private:
  JobTime& job_;
  std::int64_t begin_;
  ThreadTime thread_;
};

}  // namespace quell
