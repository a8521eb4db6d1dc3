// Work on files, cut into pieces that the host's threads share.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace quell {

// Runs piece(0) to piece(count - 1), in any order, on the threads of the arena that the caller is in. When some throw,
// what the first of them threw comes out, after all that had begun have ended. Their time is that of the caller's job.
void in_pieces(int count, const std::function<void(int)>& piece);

// A job beside others, at most one at a time, on the threads of the arena that it is started in and waited for in; who
// waits does it when no other thread has begun. Waits when destroyed; what it threw comes out of wait().
class Background {
 public:
  Background();
  ~Background();
  void start(std::function<void()> job);
  bool started() const { return started_; }
  void wait();

 private:
  struct Task;
  void finish();
  std::unique_ptr<Task> task_;
  bool started_ = false;
};

// Things that pieces borrow: as many as ever worked at once.
template <class T>
class Pool {
 public:
  // What make() gives when all that there are have been taken.
  template <class Make>
  std::unique_ptr<T> take(Make make) {
    {
      const std::scoped_lock lock(mutex_);
      if (!idle_.empty()) {
        auto thing = std::move(idle_.back());
        idle_.pop_back();
        return thing;
      }
    }
    return make();
  }
  void give_back(std::unique_ptr<T> thing) {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(thing));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> idle_;
};

}  // namespace quell
