// Frames through a graph: read ahead, filter, write behind.
#include "core/run/executor.h"

#include "core/report/error.h"
#include "core/run/session.h"
#include "core/run/state.h"
#include "core/sequence/job_time.h"
#include "core/sequence/pieces.h"

#include <fmt/format.h>

#include <time.h>

#include <memory>
#include <optional>
#include <utility>

namespace quell {

namespace {

double now(clockid_t clock) {
  timespec t;
  clock_gettime(clock, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

double seconds(std::int64_t nanoseconds) { return 1e-9 * double(nanoseconds); }

bool equal(const std::vector<quell_shape>& a, const std::vector<quell_shape>& b) {
  return std::ranges::equal(a, b, [](const auto& x, const auto& y) {
    return x.width == y.width && x.height == y.height && x.channels == y.channels;
  });
}

class Run {
 public:
  Run(const Graph& graph, FrameSource& source, FrameSink& sink, const RunOptions& options, Workers& workers)
      : graph_(graph), source_(source), sink_(sink), options_(options), workers_(workers) {
    for (const auto& input : graph.inputs) roles_.push_back(input.name);
    for (const auto& node : graph.nodes) report_.nodes.push_back({node.name, std::string(node.type().name()), 0});
    report_.threads = workers_.threads();
  }

  RunReport run() {
    const double begin = now(CLOCK_MONOTONIC), cpu = now(CLOCK_PROCESS_CPUTIME_ID);
    const auto& frames = source_.frames();
    if (frames.empty()) throw Error(Exit::input, "the sequence has no frames");
    enter(source_.shapes(frames[0], roles_));
    if (!options_.load_state.empty()) resume(frames[0]);
    try {
      for (std::size_t i = 0; i < frames.size(); ++i) run_frame(i);
    } catch (const Error& e) {
      writer_.wait();  // what went wrong with an earlier frame comes first
      if (e.exit() == Exit::interrupted && !options_.save_cancelled.empty() && report_.frames > 0)
        save_state(options_.save_cancelled, graph_, *session_, frames[report_.frames - 1]);
      throw;
    } catch (...) {
      writer_.wait();
      throw;
    }
    writer_.wait();
    if (!options_.save_state.empty()) save_state(options_.save_state, graph_, *session_, frames.back());
    report_.wall = now(CLOCK_MONOTONIC) - begin;
    report_.read_wall = seconds(reading_.wall), report_.read_cpu = seconds(reading_.cpu);
    report_.write_wall = seconds(writing_.wall), report_.write_cpu = seconds(writing_.cpu);
    // Of the process, less what reading and writing took.
    report_.filter_cpu = now(CLOCK_PROCESS_CPUTIME_ID) - cpu - report_.read_cpu - report_.write_cpu;
    return std::move(report_);
  }

 private:
  void enter(std::vector<quell_shape> shapes) {
    session_.reset();  // first, so that two plans never live at once
    session_ = std::make_unique<Session>(graph_, std::move(shapes), workers_, options_);
    const auto& plan = session_->plan();
    report_.plan_bytes = std::max(report_.plan_bytes, plan.bytes());
    const int in_flight = options_.overlap ? plan.overlap().frames_in_flight() : 1;
    report_.frames_in_flight = report_.frames_in_flight ? std::min(report_.frames_in_flight, in_flight) : in_flight;
    if (workers_.threads() > 1 && plan.overlap().frames_in_flight() < Overlap{}.frames_in_flight())
      report_.wanted_bytes = std::max(report_.wanted_bytes, Plan(graph_, session_->input_shapes()).bytes());
  }

  void run_frame(std::size_t i) {
    const auto& frames = source_.frames();
    // Nodes look too, but a graph may have none that run.
    if (options_.cancel && options_.cancel->load()) throw Error(Exit::interrupted, "interrupted");
    if (reader_.started())
      reader_.wait();
    else
      read(frames[i], session_->inputs(0));
    if (pending_shapes_) {
      report_.resized.push_back(frames[i]);
      // The frame has another size: a new plan, and the frame is read into it.
      writer_.wait();
      enter(*std::exchange(pending_shapes_, std::nullopt));
      read(frames[i], session_->inputs(0));
    } else if (i > 0 && source_.cut_before(frames[i])) {
      writer_.wait();
      session_->forget();
    }
    const bool begins = session_->age() == 0;
    if (begins) ++report_.resets;
    const auto overlap = options_.overlap ? session_->plan().overlap() : Overlap{false, false};
    if (overlap.reading && i + 1 < frames.size())
      reader_.start([this, frame = frames[i + 1], images = session_->inputs(1)] { read(frame, images); });
    filter(frames[i]);
    if (overlap.writing)
      writer_.start(
          [this, frame = frames[i], outputs = session_->outputs(), begins] { write(frame, outputs, begins); });
    else
      write(frames[i], session_->outputs(), begins);
    session_->advance();
    ++report_.frames;
    if (options_.progress) options_.progress({frames[i], i + 1, frames.size()});
  }

  void resume(std::int64_t first) {
    const auto saved = load_state(options_.load_state, graph_, *session_);
    if (first != saved + 1)
      throw Error(
          Exit::input,
          fmt::format("{}: cannot load state: it was saved after frame {}, so a run must go on with frame {}, not {}",
                      options_.load_state.string(), saved, saved + 1, first));
    if (source_.declared_cut(first)) session_->forget();
  }

  // Reads a frame, unless its size differs from the plan's: then only its shapes are kept.
  void read(std::int64_t frame, const std::vector<quell_image>& images) {
    const JobSpan job(reading_);
    const Trace::Span span(options_.trace, {"read", "file", frame}, Trace::kReading);
    auto shapes = source_.shapes(frame, roles_);
    if (equal(shapes, session_->input_shapes()))
      source_.read(frame, roles_, images);
    else
      pending_shapes_ = std::move(shapes);
  }

  void write(std::int64_t frame, const std::vector<quell_image>& outputs, bool begins) {
    const JobSpan job(writing_);
    const Trace::Span span(options_.trace, {"write", "file", frame}, Trace::kWriting);
    if (begins) sink_.history_begins(frame);
    sink_.write(frame, outputs);
  }

  void filter(std::int64_t frame) {
    node_times_.assign(graph_.nodes.size(), 0);
    node_busy_.assign(graph_.nodes.size(), 0);
    const double wall = now(CLOCK_MONOTONIC), cpu = now(CLOCK_PROCESS_CPUTIME_ID);
    {
      const Trace::Span span(options_.trace, {"frame", "graph", frame}, Trace::kGraph);
      session_->filter(frame, node_times_);
    }
    for (std::size_t n = 0; n < node_busy_.size(); ++n) node_busy_[n] = session_->busy(n);
    const FrameTimes times{frame, now(CLOCK_MONOTONIC) - wall, now(CLOCK_PROCESS_CPUTIME_ID) - cpu, node_times_,
                           node_busy_};
    report_.filter_wall += times.wall;
    for (std::size_t n = 0; n < node_times_.size(); ++n) report_.nodes[n].wall += node_times_[n];
    if (options_.frame_times) options_.frame_times(times);
  }

  const Graph& graph_;
  FrameSource& source_;
  FrameSink& sink_;
  const RunOptions& options_;
  Workers& workers_;
  std::vector<std::string> roles_;
  std::vector<double> node_times_, node_busy_;  // of the frame being filtered
  JobTime reading_, writing_;
  RunReport report_;
  std::unique_ptr<Session> session_;
  std::optional<std::vector<quell_shape>> pending_shapes_;
  Background reader_, writer_;  // last: they wait for their jobs before anything that these use goes
};

}  // namespace

RunReport run_graph(const Graph& graph, FrameSource& source, FrameSink& sink, const RunOptions& options) {
  Workers workers(options.threads, options.cancel, options.trace);
  return workers.inside([&] { return Run(graph, source, sink, options, workers).run(); });
}

}  // namespace quell
