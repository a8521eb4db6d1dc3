// What a run did when: events of bands, frames, reading and writing, for a timeline such as chrome://tracing draws.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace quell {

// Grows with the run, by an event a band.
class Trace {
 public:
  enum Track { kReading, kWriting, kGraph, kThreads };  // from kThreads on, a track for each thread that filtered

  // Names are not copied: they outlive the trace.
  struct Label {
    std::string_view name, category;
    std::int64_t frame = 0;
    int y0 = 0, y1 = 0;  // rows [y0, y1), where there are rows
  };

  // An event from its making to its end; without a trace it costs one comparison at each.
  class Span {
   public:
    // On the track of the thread that makes it.
    Span(Trace* trace, const Label& label) : Span(trace, label, -1) {}
    Span(Trace* trace, const Label& label, Track track) : Span(trace, label, int(track)) {}
    ~Span() {
      if (trace_) trace_->add(label_, track_, begin_, Clock::now());
    }
    Span(const Span&) = delete;
    Span& operator=(const Span&) = delete;

   private:
    Span(Trace* trace, const Label& label, int track) : trace_(trace) {
      if (trace_) label_ = label, track_ = track, begin_ = Clock::now();
    }
    Trace* trace_;
    Label label_;
    int track_ = 0;
    std::chrono::steady_clock::time_point begin_;
  };

  // The trace event format: complete events in microseconds since the trace was made, and a name for each track.
  std::string json() const;
  // The same to a file. Throws Error(Exit::resources).
  void write(const std::string& path) const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Event {
    Label label;
    int track;
    Clock::time_point begin, end;
  };
  void add(const Label&, int track, Clock::time_point begin, Clock::time_point end);

  Clock::time_point start_ = Clock::now();
  mutable std::mutex mutex_;
  std::vector<Event> events_;
  std::vector<std::thread::id> threads_;  // in the order in which they came to work
};

}  // namespace quell
