// Runs a graph, judges its frames as they come and compares some with golden images.
#include "core/lab/suite_run.h"

#include "core/image/image.h"
#include "core/lab/group_run.h"
#include "core/report/error.h"
#include "core/run/provenance.h"
#include "core/sequence/frame_pattern.h"
#include "core/sequence/image_file.h"
#include "core/sequence/image_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

namespace quell {

namespace {

Image read_golden(const std::string& path) {
  ImageFile file(path);
  const char* names[] = {"R", "G", "B"};
  std::vector<ChannelRead> reads;
  Image image;
  for (int c = 0; c < 3; ++c) {
    const int channel = file.find(names[c]);
    if (channel < 0) throw Error(Exit::input, fmt::format("{} has no channel {}", path, names[c]));
    if (image.empty()) image = Image(file.size(channel).width, file.size(channel).height, 3);
    reads.push_back({channel, image.row(c, 0)});
  }
  file.read(reads, image.pitch());
  return image;
}

class TestSink : public FrameSink {
 public:
  TestSink(const SuiteTest& test, const Trial& trial, const Group& group, const SuiteRunOptions& options,
           Provenance provenance, TestOutcome& outcome)
      : test_(test),
        trial_(trial),
        group_(group),
        options_(options),
        provenance_(std::move(provenance)),
        outcome_(outcome) {}
  void history_begins(std::int64_t frame) override { provenance_.history_begins(frame); }

  void write(std::int64_t frame, std::span<const quell_image> outputs) override {
    group_.take(frame, outputs, std::span(&entry_, 1));
    made_ = provenance_.texts(frame);
    if (test_.golden && std::ranges::find(test_.golden->frames, frame) != test_.golden->frames.end())
      golden(frame, outputs[std::size_t(trial_.variants().front().judged)]);
  }

  const JournalEntry& entry() const { return entry_; }

 private:
  void golden(std::int64_t frame, const quell_image& picture) {
    const std::string path = FramePattern(test_.golden->pattern).path(frame);
    if (options_.update_golden) {
      WriteOptions options;
      // Golden images are kept with the project: what they say holds in every checkout of it.
      for (const auto key :
           {"Software", "quell:version", "quell:simd", "quell:plugins", "quell:graph", "quell:fingerprint"})
        options.metadata[key] = made_.at(key);
      write_image(path, picture, QUELL_RADIANCE, options);
      outcome_.written.push_back(path);
      return;
    }
    std::error_code error;
    if (!std::filesystem::exists(path, error))
      return fail(frame, picture, fmt::format("there is no golden image {}; --update-golden makes it", path));
    const Image golden = read_golden(path);
    if (golden.width() != picture.width || golden.height() != picture.height)
      return fail(frame, picture,
                  fmt::format("the picture is {}x{}, but its golden image {} is {}x{}", picture.width, picture.height,
                              path, golden.width(), golden.height()));
    const auto difference = compare_golden(picture, golden.view(), test_.golden->tolerance);
    if (const auto problem = difference.problem(test_.golden->tolerance); !problem.empty())
      fail(frame, picture, problem + ", from " + path, &golden);
  }

  void fail(std::int64_t frame, const quell_image& picture, const std::string& why, const Image* golden = nullptr) {
    std::string text = fmt::format("frame {}: {}", frame, why);
    if (!options_.failures.empty()) {
      const auto file = [&](const char* kind) {
        return FramePattern((options_.failures / fmt::format("{}.{}.####.exr", test_.name, kind)).string()).path(frame);
      };
      WriteOptions options;
      options.metadata = made_;
      const auto& judged = trial_.variants().front();
      options.metadata["quell:output"] =
          output_text(judged.plain, judged.plain.outputs[std::size_t(judged.judged)], options);
      write_image(file("found"), picture, QUELL_RADIANCE, options);
      if (golden) write_image(file("golden"), golden->view(), QUELL_RADIANCE);
      text += fmt::format("; see {}", file("found"));
    }
    outcome_.failures.push_back(std::move(text));
  }

  const SuiteTest& test_;
  const Trial& trial_;
  const Group& group_;
  const SuiteRunOptions& options_;
  Provenance provenance_;
  TestOutcome& outcome_;
  JournalEntry entry_;
  Texts made_;  // of this frame
};

void check_conditions(const SuiteTest& test, const Trial& trial, const JournalEntry& entry, TestOutcome& outcome) {
  for (const auto& t : test.fail) {
    const auto& metrics = trial.metrics();
    const auto m = std::size_t(std::ranges::find(metrics, t.metric, &Metric::name) - metrics.begin());
    std::vector<double> numbers;
    for (auto f = std::size_t(test.study.warm_up); f < entry.numbers.size(); ++f)
      if (entry.numbers[f][m]) numbers.push_back(*entry.numbers[f][m]);
    if (numbers.empty()) {
      outcome.failures.push_back(fmt::format("{}: no frame behind the warm-up has a number of this metric", t.text));
      continue;
    }
    const double number = t.of(summarize(numbers));
    if (t.met_by(number)) outcome.failures.push_back(fmt::format("{}: the {} is {:.6g}", t.text, t.statistic, number));
  }
}

}  // namespace

TestOutcome run_test(const SuiteTest& test, const Trial& trial, Laboratory& lab, const SuiteRunOptions& options) {
  TestOutcome outcome;
  outcome.name = test.name;
  const auto begin = std::chrono::steady_clock::now();
  try {
    const Group group(test.study, trial, {0}, false);
    const auto source = trial.open(group.roles(), std::nullopt, 0, lab);
    if (!source) throw Error(lab.diagnostics.exit(), "its sequence cannot be opened");
    if (test.golden)
      for (const auto frame : test.golden->frames)
        if (std::ranges::find(source->frames(), frame) == source->frames().end())
          throw Error(Exit::usage, fmt::format("there is no frame {} to compare with a golden image", frame));
    const FileLog log(*source);
    TestSink sink(
        test, trial, group, options,
        {trial.variants().front().plain, *source, log, {options.command, options.simd, "error", {}, lab.graphs}},
        outcome);
    run_graph(group.graph(), *source, sink, options.run);
    check_conditions(test, trial, sink.entry(), outcome);
  } catch (const Error& e) {
    if (e.exit() == Exit::interrupted) throw;
    outcome.error = e.what();
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return outcome;
}

}  // namespace quell
