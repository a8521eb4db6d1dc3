// Chunks: short enough that little is lost with the process, long enough that keeping the history costs nothing.
#include "core/lab/group_run.h"

#include "core/report/error.h"
#include "core/sequence/excerpt.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace quell {

namespace {

constexpr std::size_t kFirstChunk = 2;  // frames, to learn how long one takes
constexpr double kSecondsOfChunk = 15;

class GroupSink : public FrameSink {
 public:
  GroupSink(const Group& group, JournalPart& part, const GroupOptions& options)
      : group_(group), part_(part), options_(options) {}
  void history_begins(std::int64_t frame) override {
    if (options_.images) options_.images->history_begins(frame);
  }
  void write(std::int64_t frame, std::span<const quell_image> outputs) override {
    group_.take(frame, outputs, part_.entries);
    if (options_.images) options_.images->write(frame, outputs);
  }

 private:
  const Group& group_;
  JournalPart& part_;
  const GroupOptions& options_;
};

bool same_shapes(const std::vector<quell_shape>& a, const std::vector<quell_shape>& b) {
  return std::ranges::equal(a, b, [](const auto& x, const auto& y) {
    return x.width == y.width && x.height == y.height && x.channels == y.channels;
  });
}

}  // namespace

void run_group(const Group& group, FrameSource& source, JournalPart part, const Journal& journal,
               const GroupOptions& options) {
  const auto& frames = source.frames();
  const auto roles = group.roles();
  // History goes from a frame to the next unless there is a cut, a gap or another size.
  const auto goes_on = [&](std::size_t next) {
    return !source.cut_before(frames[next]) &&
           same_shapes(source.shapes(frames[next - 1], roles), source.shapes(frames[next], roles));
  };
  if (options.images)
    for (std::size_t i = 0; i < part.entries.front().numbers.size(); ++i) {
      if (i == 0 || !goes_on(i)) options.images->history_begins(frames[i]);
      options.images->pass(frames[i]);
    }
  std::size_t chunk = kFirstChunk;
  for (std::size_t next = part.entries.front().numbers.size(); next < frames.size();) {
    const std::size_t end = std::min(frames.size(), next + chunk);
    Excerpt slice(source, {frames.begin() + std::ptrdiff_t(next), frames.begin() + std::ptrdiff_t(end)});
    RunOptions run = options.run;
    const bool keep = end < frames.size() && goes_on(end);
    if (!part.state.empty()) run.load_state = journal.state_file(next).parent_path() / part.state;
    if (keep) run.save_state = journal.state_file(end);
    run.frame_times = [&](const FrameTimes& times) { group.charge(times.busy, part.entries); };
    run.progress = [&](const Progress& p) { options.done(p.frame); };
    run.save_cancelled = journal.state_file(end);
    const auto keep_part = [&](bool with_state) {
      part.state = with_state ? journal.state_file(end).filename().string() : "";
      if (options.log) part.files = options.log->text();
      journal.save(part);
    };
    GroupSink sink(group, part, options);
    const auto begin = std::chrono::steady_clock::now();
    try {
      run_graph(group.graph(), slice, sink, run);
    } catch (const Error& e) {
      const auto done = part.entries.front().numbers.size();
      if (e.exit() == Exit::interrupted && done > next && done < frames.size()) keep_part(goes_on(done));
      throw;
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    chunk = std::size_t(std::clamp(double(end - next) * kSecondsOfChunk / std::max(1e-3, taken.count()), 1.0, 1e6));
    keep_part(keep);
    next = end;
  }
  journal.finish(part);
}

}  // namespace quell
