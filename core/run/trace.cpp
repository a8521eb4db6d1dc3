// Events of a run as a timeline.
#include "core/run/trace.h"

#include "core/sequence/temporary_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace quell {

namespace {

std::string json_text(std::string_view text) { return nlohmann::json(text).dump(); }

std::string track_name(int track) {
  switch (track) {
    case Trace::kReading:
      return "reading";
    case Trace::kWriting:
      return "writing";
    case Trace::kGraph:
      return "graph";
    default:
      return fmt::format("thread {}", track - Trace::kThreads + 1);
  }
}

}  // namespace

void Trace::add(const Label& label, int track, Clock::time_point begin, Clock::time_point end) {
  const std::scoped_lock lock(mutex_);
  if (track < 0) {
    const auto it = std::ranges::find(threads_, std::this_thread::get_id());
    track = int(kThreads + (it - threads_.begin()));
    if (it == threads_.end()) threads_.push_back(std::this_thread::get_id());
  }
  events_.push_back({label, track, begin, end});
}

std::string Trace::json() const {
  using std::chrono::nanoseconds;
  const std::scoped_lock lock(mutex_);
  std::string out = "{\"displayTimeUnit\": \"ms\", \"traceEvents\": [";
  const auto into = std::back_inserter(out);
  for (int track = 0; track < int(kThreads + threads_.size()); ++track) {
    fmt::format_to(into, "{}\n{{\"ph\": \"M\", \"pid\": 1, \"tid\": {}, \"name\": \"thread_name\", ", track ? "," : "",
                   track);
    fmt::format_to(into, "\"args\": {{\"name\": {}}}}},\n", json_text(track_name(track)));
    fmt::format_to(into, "{{\"ph\": \"M\", \"pid\": 1, \"tid\": {0}, \"name\": \"thread_sort_index\", \"args\": {{",
                   track);
    fmt::format_to(into, "\"sort_index\": {}}}}}", track);
  }
  for (const auto& e : events_) {
    // Whole nanoseconds, so that an event that ends where its parent ends is not longer by rounding.
    const auto begin = nanoseconds(e.begin - start_).count(), length = nanoseconds(e.end - e.begin).count();
    fmt::format_to(into, ",\n{{\"ph\": \"X\", \"pid\": 1, \"tid\": {}, \"name\": {}, \"cat\": {}, ", e.track,
                   json_text(e.label.name), json_text(e.label.category));
    fmt::format_to(into, "\"ts\": {}.{:03}, \"dur\": {}.{:03}, \"args\": {{\"frame\": {}", begin / 1000, begin % 1000,
                   length / 1000, length % 1000, e.label.frame);
    if (e.label.y1 > e.label.y0) fmt::format_to(into, ", \"rows\": \"{}-{}\"", e.label.y0, e.label.y1 - 1);
    out += "}}";
  }
  return out + "\n]}\n";
}

void Trace::write(const std::string& path) const { write_file(path, json()); }

}  // namespace quell
