// Random graphs through the executor, against an interpreter that keeps every image of every frame.
#include "core/report/error.h"
#include "core/run/plan.h"
#include "tests/support/random_graph.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>

namespace quell::test {
namespace {

// Every image of every frame since history began, and nothing clever.
class Interpreter {
 public:
  explicit Interpreter(const Graph& graph) : graph_(graph) {}

  Kept run(const Course& course) {
    Kept kept;
    for (const auto frame : course.frames) {
      const auto shape = course.shapes.at(frame);
      if (!past_.empty() && (course.cuts.contains(frame) || past_.back().width != shape.width)) past_.clear();
      past_.push_back({shape.width, {}});
      auto& values = past_.back().values;
      for (std::size_t i = 0; i < graph_.inputs.size(); ++i) {
        Image image(shape);
        fill_input(image.view(), frame, i);
        values.emplace(key({Source::kInput, int(i)}), std::move(image));
      }
      for (std::size_t n = 0; n < graph_.nodes.size(); ++n)
        if (!graph_.nodes[n].type().is_weight()) evaluate(int(n), frame, shape);
      for (const auto& o : graph_.outputs) kept[frame].push_back(copy_of(read(o.wire, shape)));
    }
    return kept;
  }

 private:
  struct Frame {
    int width;
    std::map<std::pair<int, int>, Image> values;
  };
  static std::pair<int, int> key(Source s) { return {s.node, s.port}; }

  quell_image read(const Wire& w, const quell_shape& shape) {
    if (std::size_t(w.delay) < past_.size())
      return past_[past_.size() - 1 - std::size_t(w.delay)].values.at(key(w.from)).view();
    if (w.start.node != Source::kNone) return past_.back().values.at(key(w.start)).view();
    if (nothing_.width() != shape.width) nothing_ = Image(shape);
    auto image = nothing_.view();
    image.missing = 1;
    return image;
  }

  std::vector<std::vector<quell_image>> images(int n, const quell_shape& shape) {
    std::vector<std::vector<quell_image>> out;
    const auto& node = graph_.nodes[std::size_t(n)];
    for (std::size_t p = 0; p < node.in.size(); ++p) {
      auto& port = out.emplace_back();
      for (const auto& w : node.in[p])
        if (node.type().inputs()[p].type != QUELL_WEIGHT) port.push_back(read(w, shape));
    }
    return out;
  }

  void evaluate(int n, std::int64_t frame, const quell_shape& shape) {
    const auto& node = graph_.nodes[std::size_t(n)];
    const auto in_images = images(n, shape);
    std::vector<quell_input> in;
    for (const auto& port : in_images) in.push_back({port.data(), nullptr, int(port.size())});
    std::vector<std::vector<std::vector<quell_image>>> weight_images;
    std::vector<std::vector<quell_input>> weight_in;
    std::vector<quell_bound_weight> weights;
    if (node.type().name() == "filter") {
      for (const auto& w : node.in[1]) {
        const auto& weight = graph_.nodes[std::size_t(w.from.node)];
        weight_images.push_back(images(w.from.node, shape));
        auto& ports = weight_in.emplace_back();
        for (const auto& port : weight_images.back()) ports.push_back({port.data(), nullptr, int(port.size())});
        weights.push_back({weight.type().table().weigh, weight.instance.data(), nullptr, ports.data()});
      }
      in[1] = {nullptr, weights.data(), int(weights.size())};
    }
    std::vector<Image> out;
    std::vector<quell_image> out_views;
    for (std::size_t o = 0; o < node.type().outputs().size(); ++o) {
      const int with = node.type().outputs()[o].with;
      const bool exists = with < 0 || !node.in[std::size_t(with)].empty();
      out.push_back(exists ? Image(shape) : Image());
    }
    for (const auto& image : out) out_views.push_back(image.view());
    for (std::size_t o = 0; o < out.size(); ++o)
      if (out[o].empty()) out_views[o] = {};
    const quell_tile tile{in.data(), out_views.data(), 0, 0, shape.width, shape.height, frame};
    quell_error error{};
    ASSERT_EQ(node.type().table().run(node.instance.data(), nullptr, &tile, &error), 0) << error.text;
    for (std::size_t o = 0; o < out.size(); ++o)
      if (!out[o].empty()) past_.back().values.emplace(key({n, int(o)}), std::move(out[o]));
  }

  const Graph& graph_;
  std::vector<Frame> past_;  // the last is the current one
  Image nothing_;
};
// Bytes that suffice for every size of the course with as much overlap.
std::size_t limit_for(const Graph& graph, const Course& course, Overlap overlap) {
  std::size_t bytes = 0;
  for (const auto& [frame, shape] : course.shapes)
    bytes = std::max(bytes, Plan(graph, std::vector<quell_shape>(graph.inputs.size(), shape), overlap).bytes());
  return bytes;
}

TEST(ExecutorRandom, AgreesWithAnInterpreterThatKeepsAllFrames) {
  const auto state =
      std::filesystem::temp_directory_path() / fmt::format("quell_random_{}.state", static_cast<long>(getpid()));
  for (unsigned seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    const RandomGraph made(random);
    const auto course = random_course(random);
    if (!has_sizes(made.graph())) {
      Kept none;
      EXPECT_THROW(run_part(made.graph(), course, 0, course.frames.size(), seed, {}, none), Error) << seed;
      continue;
    }
    const auto expected = Interpreter(made.graph()).run(course);
    ASSERT_FALSE(HasFatalFailure());
    RunOptions options;
    options.threads = 1 + random.below(3);
    options.band_rows = random.below(4);
    const bool reading = random.one_in(2), writing = random.one_in(2);
    options.max_memory = limit_for(made.graph(), course, {reading, writing});
    Kept whole;
    run_part(made.graph(), course, 0, course.frames.size(), seed, options, whole);
    ASSERT_EQ(first_difference(whole, expected), "") << "seed " << seed << "\n" << fingerprint_text(made.graph());

    // In two parts. A state goes with the size of its frames.
    const auto at = std::size_t(random.below(int(course.frames.size())));
    if (at == 0 || course.shapes.at(course.frames[at]).width != course.shapes.at(course.frames[at - 1]).width) continue;
    Kept parts;
    auto first = options, second = options;
    first.save_state = second.load_state = state;
    run_part(made.graph(), course, 0, at, seed, first, parts);
    run_part(made.graph(), course, at, course.frames.size(), seed, second, parts);
    ASSERT_EQ(first_difference(parts, expected), "") << "seed " << seed << ", two parts at " << at << "\n"
                                                     << fingerprint_text(made.graph());
  }
  std::filesystem::remove(state);
}

}  // namespace
}  // namespace quell::test
