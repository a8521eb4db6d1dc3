// Random graphs with delays and starts, courses of frames with cuts and changes of size, and a source and a sink for
// them that take their time.
#pragma once

#include "core/image/image.h"
#include "core/plugin/registry.h"
#include "core/run/executor.h"
#include "tests/support/add_type.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <quell/node.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace quell::test {

// Two images to one, so that no two values of a run are alike; a wire without a past shows, and so does a wrong image.
struct Mix {
  In<Scalar> a, b;
  Out<Scalar> mixed, extra;
  float number = 0;
  void describe(Describe& d) {
    d.summary("Mixes.");
    d.in(a, "a", "A.");
    d.in(b, "b", "B.").optional();
    d.out(mixed, "mixed", "Of A and B.");
    d.out(extra, "extra", "Of B.").with(b);
    d.param(number, "number", "Added.");
  }
  void run(const Tile& t) const {
    for (int y = t.y0; y < t.y1; ++y)
      for (int x = t.x0; x < t.x1; ++x) {
        const float from_a = t.row(a, 0, y)[x] + (t.missing(a) ? 100.0f : 0.0f);
        const float from_b = t.has(b) ? t.row(b, 0, y)[x] + (t.missing(b) ? 1000.0f : 0.0f) : 0.0f;
        t.row(mixed, 0, y)[x] = 0.625f * from_a + 0.375f * from_b + number;
        if (t.has(b)) t.row(extra, 0, y)[x] = 0.5f * from_b - number;
      }
  }
};

// Says how large its inputs are at the centre.
struct Unlike {
  In<Scalar> a, b;
  Out<Weight> weight;
  float number = 0;
  void describe(Describe& d) {
    d.summary("Weighs.");
    d.in(a, "a", "A.");
    d.in(b, "b", "B.").optional();
    d.out(weight, "weight", "Of A and B.");
    d.param(number, "number", "Added.");
  }
  void weigh(const quell_input* in, const quell_run& run, float* exponent) const {
    for (int i = 0; i < run.n; ++i) {
      float e = 0.25f * std::abs(plane(in, a, 0)[run.at + i]) + number;
      if (has(in, b)) e += 0.125f * std::abs(plane(in, b, 0)[run.at + i]);
      exponent[i] = run.store ? e : exponent[i] + e;
    }
  }
};

// Adds what its weights say to its image.
struct Filter {
  In<Scalar> a;
  InList<Weight> weights;
  Out<Scalar> filtered;
  void describe(Describe& d) {
    d.summary("Filters.");
    d.in(a, "a", "A.");
    d.in(weights, "weights", "Weights.");
    d.out(filtered, "filtered", "The sum.");
  }
  void run(const Tile& t) const {
    const quell_tap tap{0, 0, 0};
    float exponent[32] = {};
    for (int y = t.y0; y < t.y1; ++y)
      for (int x = t.x0; x < t.x1; ++x) {
        const quell_run run{x, y, 1, 1, &tap, y * t[a].pitch + x, 32, 0, 0};
        exponent[0] = 0;
        for (const auto& w : t[weights]) w.weigh(w.instance, w.resource, w.in, &run, exponent);
        t.row(filtered, 0, y)[x] = 0.75f * t.row(a, 0, y)[x] + exponent[0] + (t.missing(a) ? 10.0f : 0.0f);
      }
  }
};

inline Registry& nodes() {
  static Registry registry({});
  static const bool added =
      add_type<Mix>(registry, "mix") && add_type<Unlike>(registry, "unlike") && add_type<Filter>(registry, "filter");
  EXPECT_TRUE(added);
  return registry;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  int below(int n) { return int(engine_() % unsigned(n)); }
  bool one_in(int n) { return below(n) == 0; }

 private:
  std::mt19937 engine_;
};

// A graph of up to nine nodes. Undelayed wires read what comes before, delayed ones anything.
class RandomGraph {
 public:
  explicit RandomGraph(Random& random) : random_(random) {
    const int inputs = 1 + random.below(3), count = 1 + random.below(9);
    for (int i = 0; i < inputs; ++i) graph_.inputs.push_back({fmt::format("i{}", i), QUELL_SCALAR, false});
    // Types, and which ports are connected, first: they decide which outputs there are.
    for (int n = 0; n < count; ++n) {
      const char* const types[] = {"mix", "mix", "unlike", "filter"};
      const auto* type = nodes().find(types[random.below(4)]);
      std::vector<int> out_types;
      for (const auto& o : type->outputs()) out_types.push_back(o.type);
      GraphNode node{fmt::format("n{}", n), Instance(*type), {{}, {}}, out_types, {}};
      if (!type->params().empty()) node.instance.set_float(0, float(n + 1) / 8);
      second_.push_back(type->name() != "filter" && random.one_in(2));
      graph_.nodes.push_back(std::move(node));
    }
    for (int n = 0; n < count; ++n) {
      auto& node = graph_.nodes[std::size_t(n)];
      node.in[0] = {wire(n)};
      if (second_[std::size_t(n)]) node.in[1] = {wire(n)};
      if (node.type().name() != "filter") continue;
      for (int w = 0; w < n; ++w)
        if (graph_.nodes[std::size_t(w)].type().is_weight() && !random.one_in(3)) node.in[1].push_back({{w, 0}, 0, {}});
    }
    const int outputs = 1 + random.below(3);
    for (int o = 0; o < outputs; ++o)
      graph_.outputs.push_back({fmt::format("o{}", o), wire(count), QUELL_SCALAR, random.one_in(4)});
  }
  const Graph& graph() const { return graph_; }

 private:
  // An input, or an output of a node before `end`.
  Source source(int end) {
    for (;;) {
      const int n = random_.below(end + int(graph_.inputs.size())) - int(graph_.inputs.size());
      if (n < 0) return {Source::kInput, -1 - n};
      const auto& type = graph_.nodes[std::size_t(n)].type();
      if (type.is_weight()) continue;
      return {n, type.name() == "mix" && second_[std::size_t(n)] ? random_.below(2) : 0};
    }
  }
  Wire wire(int node) {
    if (!random_.one_in(3)) return {source(node), 0, {}};
    Wire w{source(int(graph_.nodes.size())), 1 + random_.below(4), {}};
    if (random_.one_in(3)) w.start = source(node);
    return w;
  }

  Random& random_;
  Graph graph_;
  std::vector<bool> second_;  // whether the second input of a node is connected
};

// Whether each node reads an image whose size follows from the inputs' sizes.
inline bool has_sizes(const Graph& graph) {
  std::vector<bool> known(graph.nodes.size(), false);
  const auto sized = [&](const Source& s) {
    if (s.node < 0) return s.node == Source::kInput;
    return known[std::size_t(s.node)] && !graph.nodes[std::size_t(s.node)].type().is_weight();
  };
  for (std::size_t pass = 0; pass <= known.size(); ++pass)
    for (std::size_t n = 0; n < known.size(); ++n)
      for (const auto& port : graph.nodes[n].in)
        for (const auto& w : port) known[n] = known[n] || sized(w.from) || sized(w.start);
  return std::ranges::find(known, false) == known.end();
}

// Frames, cuts and sizes.
struct Course {
  std::vector<std::int64_t> frames;
  std::set<std::int64_t> cuts;
  std::map<std::int64_t, quell_shape> shapes;
};

inline Course random_course(Random& random) {
  Course c;
  const int count = 1 + random.below(14);
  int width = 5;
  for (int f = 1; f <= count; ++f) {
    if (random.one_in(9)) c.cuts.insert(f);
    if (random.one_in(12)) width = width == 5 ? 21 : 5;
    c.frames.push_back(f);
    c.shapes[f] = {width, 7, 1};
  }
  return c;
}

inline float input_value(std::int64_t frame, std::size_t input, int x, int y) {
  return float(frame) + 0.25f * float(input) + float(x) / 64 + float(y) / 1024;
}

inline void fill_input(const quell_image& image, std::int64_t frame, std::size_t input) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) image.plane[0][y * image.pitch + x] = input_value(frame, input, x, y);
}

inline void nap(Random& random) { std::this_thread::sleep_for(std::chrono::microseconds(random.below(4) * 100)); }

// Takes its time, and leaves garbage where the frame is to be until it is done.
class SlowSource : public FrameSource {
 public:
  SlowSource(const Course& course, std::size_t begin, std::size_t end, unsigned seed)
      : course_(course),
        frames_(course.frames.begin() + std::ptrdiff_t(begin), course.frames.begin() + std::ptrdiff_t(end)),
        random_(seed) {}
  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t f) const override { return f == frames_[0] || declared_cut(f); }
  bool declared_cut(std::int64_t f) const override { return course_.cuts.contains(f); }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t f, std::span<const std::string> roles) override {
    return std::vector<quell_shape>(roles.size(), course_.shapes.at(f));
  }
  void read(std::int64_t f, std::span<const std::string> roles, std::span<const quell_image> into) override {
    for (const auto& image : into) fill_input(image, -77, 0);
    nap(random_);
    for (std::size_t i = 0; i < roles.size(); ++i) fill_input(into[i], f, std::size_t(roles[i][1] - '0'));
  }
  std::map<std::string, Repairs> repairs() const override { return {}; }

 private:
  const Course& course_;
  std::vector<std::int64_t> frames_;
  std::map<std::string, int> roles_;
  Random random_;
};

using Kept = std::map<std::int64_t, std::vector<Image>>;  // by frame, one an output

inline Image copy_of(const quell_image& from) {
  Image copy(from.width, from.height, from.channels);
  for (int y = 0; y < from.height; ++y) std::copy_n(from.plane[0] + y * from.pitch, from.width, copy.row(0, y));
  return copy;
}

// Looks at the outputs only after a while.
class SlowSink : public FrameSink {
 public:
  SlowSink(Kept& kept, unsigned seed) : kept_(kept), random_(seed) {}
  void write(std::int64_t frame, std::span<const quell_image> outputs) override {
    nap(random_);
    for (const auto& o : outputs) kept_[frame].push_back(copy_of(o));
  }

 private:
  Kept& kept_;
  Random random_;
};

inline std::string first_difference(const Kept& a, const Kept& b) {
  if (a.size() != b.size()) return fmt::format("{} frames, not {}", a.size(), b.size());
  for (const auto& [frame, images] : a)
    for (std::size_t o = 0; o < images.size(); ++o) {
      const auto& other = b.at(frame).at(o);
      if (other.width() != images[o].width()) return fmt::format("frame {}, output {}: width", frame, o);
      for (int y = 0; y < other.height(); ++y)
        for (int x = 0; x < other.width(); ++x)
          if (images[o].at(0, x, y) != other.at(0, x, y))
            return fmt::format("frame {}, output {}, pixel ({}, {}): {}, not {}", frame, o, x, y, images[o].at(0, x, y),
                               other.at(0, x, y));
    }
  return "";
}
inline void run_part(const Graph& graph, const Course& course, std::size_t begin, std::size_t end, unsigned seed,
                     RunOptions options, Kept& kept) {
  SlowSource source(course, begin, end, seed);
  SlowSink sink(kept, seed + 1);
  run_graph(graph, source, sink, options);
}

}  // namespace quell::test
