// All of SVGF, graphs/svgf.json on the host's executor, against two opponents in one process.
//
// 1. What it could cost at best: five levels fused by hand, and for all other nodes the bytes that they must move at
// the
//    bandwidth of a triad of the same number of threads; each node by itself, and as if all of them were one.
// 2. Plain loops (naive_svgf.h), built with -O3 and all of this machine's instructions. It runs on a strip of the width
//    of the picture, for it is slow, and so does the graph beside it; both must agree.
#include "core/bench/timing.h"
#include "core/run/reads.h"
#include "tests/bench/fused_level.h"
#include "tests/bench/host_graph.h"
#include "tests/bench/naive_svgf.h"
#include "tests/bench/turns.h"

#include <bit>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

using namespace quell::bench;

constexpr int kWidth = 1920, kHeight = 1080, kStrip = 135;
constexpr int kWarmUp = 4;  // frames until all pixels that can have a history have one

// Bytes a second of a[i] = b[i] + k · c[i] over images as large as a frame's, the stores' own reads not counted.
class Triad {
 public:
  explicit Triad(int threads) : threads_(threads), a_(kFloats), b_(kFloats, 1.0f), c_(kFloats, 2.0f) {}
  void run() {
    in_bands(threads_, int(kFloats / 1024), [&](int from, int to) {
      float* a = a_.data();
      const float *b = b_.data(), *c = c_.data();
      for (std::size_t i = std::size_t(from) * 1024; i < std::size_t(to) * 1024; ++i) a[i] = b[i] + 0.5f * c[i];
    });
  }
  static double bytes() { return 3.0 * kFloats * sizeof(float); }

 private:
  static constexpr std::size_t kFloats = std::size_t(3) * kWidth * kHeight / 1024 * 1024;  // a colour image
  int threads_;
  std::vector<float> a_, b_, c_;
};

bool in_level(const HostGraph& graph, int node) {
  return node >= 0 && graph.graph().nodes[std::size_t(node)].name.starts_with("level");
}

// What all nodes but those of the levels must move: each image that a node reads or writes, once a node.
double bytes_beside_levels(const HostGraph& graph) {
  double bytes = 0;
  for (std::size_t n = 0; n < graph.graph().nodes.size(); ++n)
    if (!graph.graph().nodes[n].type().is_weight() && !in_level(graph, int(n)))
      bytes += double(quell::traffic(graph.plan(), n));
  return bytes;
}

// The same, were all of these nodes one pass over the picture: what comes from outside of them, once, and what the
// levels, the next frame or the caller need of them.
double bytes_of_one_pass(const HostGraph& graph) {
  const auto& g = graph.graph();
  std::set<std::pair<std::size_t, int>> read, written;  // value and delay
  const auto outside = [&](const quell::Wire& w) {
    return w.from.node == quell::Source::kInput || w.delay > 0 || in_level(graph, w.from.node);
  };
  for (std::size_t n = 0; n < g.nodes.size(); ++n) {
    if (g.nodes[n].type().is_weight()) continue;
    quell::for_each_read(g, n, [&](const quell::Wire& w) {
      const auto value = graph.plan().value_of(w.from);
      if (in_level(graph, int(n)) ? !outside(w) : w.delay > 0 && w.from.node >= 0 && !in_level(graph, w.from.node))
        written.emplace(value, 0);
      if (!in_level(graph, int(n)) && outside(w)) read.emplace(value, w.delay);
    });
  }
  for (const auto& output : g.outputs) written.emplace(graph.plan().value_of(output.wire.from), 0);
  double bytes = 0;
  for (const auto* set : {&read, &written})
    for (const auto& [value, delay] : *set) {
      const auto& s = graph.plan().values()[value].shape;
      bytes += double(s.width) * s.height * s.channels * sizeof(float);
    }
  return bytes;
}

void against_the_floor([[maybe_unused]] int rounds, [[maybe_unused]] int threads) {
#ifdef __AVX512F__
  HostGraph graph(load("svgf"), kWidth, kHeight, threads);
  for (int f = 0; f < kWarmUp; ++f) graph.filter(), graph.advance();
  Padded signal[2] = {{kWidth, kHeight, 4}, {kWidth, kHeight, 4}}, guides(kWidth, kHeight, 6);
  const auto normal = quell::synthetic_image(QUELL_NORMAL, kWidth, kHeight, 0),
             depth = quell::synthetic_image(QUELL_DEPTH, kWidth, kHeight, 0),
             slope = quell::synthetic_image(QUELL_SLOPE, kWidth, kHeight, 0),
             color = quell::synthetic_image(QUELL_RADIANCE, kWidth, kHeight, 0),
             variance = quell::synthetic_image(QUELL_VARIANCE, kWidth, kHeight, 0);
  guides.take(0, normal.view()), guides.take(3, depth.view()), guides.take(4, slope.view());
  signal[0].take(0, color.view()), signal[0].take(3, variance.view());
  const FusedLevel level(kWidth, kHeight, {});
  Triad triad(threads);
  const auto five = [&](auto borders) {
    for (int i = 0; i < 5; ++i)
      in_bands(threads, kHeight, [&](int y0, int y1) {
        level.band<borders()>(signal[i % 2], guides, signal[(i + 1) % 2], 1 << i, y0, y1);
      });
  };
  std::printf("%d thread%s, %dx%d\n", threads, threads > 1 ? "s" : "", kWidth, kHeight);
  const auto costs = contest(rounds, {{"five fused levels, with borders", [&] { five(std::true_type{}); }},
                                      {"five fused levels, padded", [&] { five(std::false_type{}); }},
                                      graph.contestant("graph"),
                                      {"triad of 25 MB each", [&] { triad.run(); }}});
  const double bandwidth = Triad::bytes() / costs[3].wall;
  const auto print_floor = [&](const char* what, double bytes) {
    const double floor = bytes / bandwidth;
    std::printf("  %s: %.0f MB at %.1f GB/s, %.2f ms; graph : (levels with borders + that) = %.3f\n", what,
                bytes * 1e-6, bandwidth * 1e-9, floor * 1e3, costs[2].wall / (costs[0].wall + floor));
  };
  print_floor("the other nodes, each by itself", bytes_beside_levels(graph));
  print_floor("the other nodes, were they one", bytes_of_one_pass(graph));
#else
  std::puts("built without AVX-512: no fused levels to compare with");
#endif
}

NaiveFrame frame_of(const HostGraph& graph) {
  const auto inputs = graph.inputs();
  const auto input = [&](const char* name) {
    std::size_t i = 0;
    while (graph.graph().inputs[i].name != name) ++i;
    return inputs[i];
  };
  return {colors(input("color")),
          colors(input("albedo")),
          colors(input("normal")),
          colors(input("emission")),
          picture<float>(input("depth"), [](auto at) { return at(0); }),
          picture<Pair>(input("motion"),
                        [](auto at) {
                          return Pair{at(0), at(1)};
                        }),
          picture<std::uint32_t>(input("id"), [](auto at) { return std::bit_cast<std::uint32_t>(at(0)); })};
}

// Share of the pixels that differ by more than a thousandth of 1 + their value. A few may: where a guide lies on the
// edge of a test, rounding decides.
double disagreement(const quell_image& image, const Picture<Rgb>& other) {
  long differ = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Rgb o = other(x, y);
      const float mine[] = {o.r, o.g, o.b};
      bool far = false;
      for (int c = 0; c < 3; ++c) {
        const float value = image.plane[c][y * image.pitch + x];
        far |= !(std::abs(value - mine[c]) <= 1e-3f * (1 + std::abs(value)));
      }
      differ += far;
    }
  return double(differ) / (double(image.width) * image.height);
}

bool against_plain_loops(int rounds, int threads) {
  HostGraph graph(load("svgf"), kWidth, kStrip, threads);
  NaiveSvgf naive(kWidth, kStrip, threads);
  double differ = 0;
  for (int f = 0; f < kWarmUp; ++f) {
    const auto out = naive.filter(frame_of(graph), true);
    graph.filter();
    differ = std::max(differ, disagreement(graph.outputs()[0], out));
    graph.advance();
  }
  const auto frame = frame_of(graph);
  std::printf("%d thread%s, %dx%d; frames differ in %.4f %% of the pixels at most\n", threads, threads > 1 ? "s" : "",
              kWidth, kStrip, 100 * differ);
  contest(rounds, {graph.contestant("graph"), {"plain loops", [&] { naive.filter(frame, false); }}});
  return differ < 1e-3;
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 5;
  bool agree = true;
  for (const int threads : {1, 2}) against_the_floor(3 * rounds, threads);
  for (const int threads : {1, 2}) agree &= against_plain_loops(rounds, threads);
  if (!agree) std::puts("the graph and the plain loops disagree: the comparison means nothing");
  return agree ? 0 : 1;
}
