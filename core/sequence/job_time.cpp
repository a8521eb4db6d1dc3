// A stack of jobs for each thread; the innermost gets the time.
#include "core/sequence/job_time.h"

#include <time.h>

namespace quell {

namespace {

thread_local ThreadTime* innermost = nullptr;

std::int64_t now(clockid_t clock) {
  timespec t;
  clock_gettime(clock, &t);
  return std::int64_t(t.tv_sec) * 1'000'000'000 + t.tv_nsec;
}

}  // namespace

ThreadTime::ThreadTime(JobTime* job) : job_(job), outer_(innermost) {
  innermost = this;
  // Without a job inside or outside nothing is to be measured: most bands of most nodes.
  if (!job_ && !outer_) return;
  since_ = now(CLOCK_THREAD_CPUTIME_ID);
  if (outer_) outer_->charge(since_);
}

ThreadTime::~ThreadTime() {
  innermost = outer_;
  if (!job_ && !outer_) return;
  const auto end = now(CLOCK_THREAD_CPUTIME_ID);
  charge(end);
  if (outer_) outer_->since_ = end;
}

void ThreadTime::charge(std::int64_t end) {
  if (job_) job_->cpu += end - since_;
  since_ = end;
}

JobTime* ThreadTime::job() { return innermost ? innermost->job_ : nullptr; }

JobSpan::JobSpan(JobTime& job) : job_(job), begin_(now(CLOCK_MONOTONIC)), thread_(&job) {}
JobSpan::~JobSpan() { job_.wall += now(CLOCK_MONOTONIC) - begin_; }

}  // namespace quell
