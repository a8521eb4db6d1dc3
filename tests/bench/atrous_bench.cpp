// What weights as nodes cost: an à-trous level of SVGF as four plugins against the same level fused by hand.
//
// Both filter 1080p, in turn: first plugin and opponent band by band on one thread, where the minimum of each band over
// the rounds counts, in thread CPU time, so that other work on the machine disturbs least; then whole frames, the graph
// on the host's executor, on one thread and on two. "With borders" is the opponent that drops taps outside of the image
// as the graph does; "padded" takes them from a border of zero normals and checks nothing. The largest difference shows
// that both computed the same (but for misses, between which the opponent knows no weight).
#include "tests/bench/fused_level.h"
#include "tests/bench/host_graph.h"
#include "tests/bench/turns.h"

#include <cstdio>
#include <cstdlib>

#ifdef __AVX512F__
namespace {

using namespace quell::bench;
using quell::Image;
using quell::test::Node;

constexpr int kWidth = 1920, kHeight = 1080, kBand = 270;
constexpr int kSteps[] = {1, 2, 4, 8, 16};
constexpr LevelRule kRule{4, 1, 1e-4f, 128, false};

// A quiet picture: a weight that is rarely exactly 0 or 1.
struct Scene {
  Image color{kWidth, kHeight, 3}, variance{kWidth, kHeight, 1}, normal{kWidth, kHeight, 3}, depth{kWidth, kHeight, 1},
      slope{kWidth, kHeight, 2};

  Scene()
      : color(quell::test::noise_image(kWidth, kHeight, 3, 1)),
        variance(quell::test::noise_image(kWidth, kHeight, 1, 2, 0.01f, 0.06f)) {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const float u = float(x) / 240, v = float(y) / 180;
        const float a = std::sin(std::floor(u) * 1.7f) * 0.5f + 0.1f * std::sin(u * 3),
                    b = std::cos(std::floor(v) * 2.3f) * 0.5f;
        const float length = std::sqrt(a * a + b * b + 1);
        normal.at(0, x, y) = a / length, normal.at(1, x, y) = b / length, normal.at(2, x, y) = 1 / length;
        depth.at(0, x, y) = 5 + u * 0.3f + v * 0.2f + std::floor(u);
        slope.at(0, x, y) = 0.3f / 240, slope.at(1, x, y) = 0.2f / 180;
      }
  }
};

class Fused {
 public:
  explicit Fused(const Scene& s) {
    in_.take(0, s.color.view()), in_.take(3, s.variance.view());
    guides_.take(0, s.normal.view()), guides_.take(3, s.depth.view()), guides_.take(4, s.slope.view());
  }
  template <bool kBorders>
  void band(int step, int y0, int y1) {
    level_.band<kBorders>(in_, guides_, out_, step, y0, y1);
  }
  float at(int channel, int x, int y) const { return out_.row(channel, y)[x]; }

 private:
  FusedLevel level_{kWidth, kHeight, kRule};
  Padded in_{kWidth, kHeight, 4}, guides_{kWidth, kHeight, 6}, out_{kWidth, kHeight, 4};
};

// The same level as a graph would run it: atrous with three weight nodes, each from its own library.
class Plugins {
 public:
  explicit Plugins(const Scene& s)
      : image_(s.color.view()),
        variance_(s.variance.view()),
        color_out_(kWidth, kHeight, 3),
        variance_out_(kWidth, kHeight, 1) {
    normal_.set("power", kRule.power).in("normal", s.normal);
    depth_.set("sigma", kRule.sigma_depth).set("epsilon", kRule.epsilon).in("depth", s.depth).in("slope", s.slope);
    luminance_.set("sigma", kRule.sigma_luminance).set("epsilon", kRule.epsilon);
    luminance_.in("image", s.color).in("variance", s.variance);
    for (Node* node : {&normal_, &depth_, &luminance_}) weights_.push_back(node->bound());
    out_[0] = color_out_.view(), out_[1] = variance_out_.view();
    inputs_[0] = {&image_, nullptr, 1}, inputs_[1] = {&variance_, nullptr, 1};
    inputs_[2] = {nullptr, weights_.data(), int(weights_.size())};
  }
  void band(int step, int y0, int y1) {
    const auto* type = quell::test::registry().find("atrous");
    quell::Instance instance(*type);
    instance.set_int(type->find_param("step"), step);
    const quell_tile tile{inputs_, out_, 0, y0, kWidth, y1, 0};
    quell_error error;
    if (type->table().run(instance.data(), nullptr, &tile, &error)) std::fprintf(stderr, "%s\n", error.text);
  }
  float at(int channel, int x, int y) const {
    return channel < 3 ? color_out_.at(channel, x, y) : variance_out_.at(0, x, y);
  }

 private:
  Node normal_{"normal_weight"}, depth_{"depth_weight"}, luminance_{"luminance_weight"};
  std::vector<quell_bound_weight> weights_;
  quell_image image_, variance_, out_[2];
  quell_input inputs_[3];
  Image color_out_, variance_out_;
};

double difference(const Fused& a, const Plugins& b) {
  double most = 0;
  for (int c = 0; c < 4; ++c)
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) most = std::max(most, double(std::abs(a.at(c, x, y) - b.at(c, x, y))));
  return most;
}

void band_by_band(int rounds) {
  static const Scene scene;
  static Fused fused(scene);
  static Plugins plugins(scene);
  std::puts("one thread, band by band, CPU time");
  double sums[3] = {};
  for (const int step : kSteps) {
    double spent[3] = {};  // padded, with borders, plugins
    for (int y = 0; y < kHeight; y += kBand) {
      double least[3] = {1e9, 1e9, 1e9};
      for (int i = 0; i < rounds; ++i) {
        const double a = seconds(CLOCK_THREAD_CPUTIME_ID);
        fused.band<false>(step, y, y + kBand);
        const double b = seconds(CLOCK_THREAD_CPUTIME_ID);
        fused.band<true>(step, y, y + kBand);
        const double c = seconds(CLOCK_THREAD_CPUTIME_ID);
        plugins.band(step, y, y + kBand);
        const double took[] = {b - a, c - b, seconds(CLOCK_THREAD_CPUTIME_ID) - c};
        for (int k = 0; k < 3; ++k) least[k] = std::min(least[k], took[k]);
      }
      for (int k = 0; k < 3; ++k) spent[k] += least[k];
    }
    std::printf(
        "  step %2d: padded %6.1f ms, with borders %6.1f ms, plugins %6.1f ms: %.3f and %.3f times; "
        "largest difference %.1e\n",
        step, spent[0] * 1e3, spent[1] * 1e3, spent[2] * 1e3, spent[2] / spent[0], spent[2] / spent[1],
        difference(fused, plugins));
    for (int k = 0; k < 3; ++k) sums[k] += spent[k];
  }
  std::printf("  five levels: padded %.1f ms, with borders %.1f ms, plugins %.1f ms: %.3f and %.3f times\n",
              sums[0] * 1e3, sums[1] * 1e3, sums[2] * 1e3, sums[2] / sums[0], sums[2] / sums[1]);
}

constexpr const char* kLevel = R"({
  "quell": 1, "name": "Level",
  "inputs": { "image": "radiance", "variance": "variance", "normal": "normal", "depth": "depth", "slope": "slope" },
  "params": { "step": 1 },
  "nodes": {
    "by_normal":    { "type": "normal_weight", "in": { "normal": "normal" } },
    "by_depth":     { "type": "depth_weight", "in": { "depth": "depth", "slope": "slope" } },
    "by_luminance": { "type": "luminance_weight", "in": { "image": "image", "variance": "variance" } },
    "atrous":       { "type": "atrous", "set": { "step": "$step" },
                      "in": { "image": "image", "variance": "variance", "weights": ["by_normal", "by_depth", "by_luminance"] } }
  },
  "outputs": { "image": "atrous.image", "variance": "atrous.variance" }
})";

void on_the_host(int rounds, int threads) {
  std::printf("%d thread%s, whole frames, the graph on the host's executor\n", threads, threads > 1 ? "s" : "");
  double sums[3] = {};
  for (const int step : kSteps) {
    HostGraph graph(load("level.json", {"step=" + std::to_string(step)}, kLevel), kWidth, kHeight, threads);
    Padded in(kWidth, kHeight, 4), guides(kWidth, kHeight, 6), out(kWidth, kHeight, 4);
    const auto inputs = graph.inputs();
    in.take(0, inputs[0]), in.take(3, inputs[1]);
    guides.take(0, inputs[2]), guides.take(3, inputs[3]), guides.take(4, inputs[4]);
    const FusedLevel level(kWidth, kHeight, kRule);
    std::printf(" step %d\n", step);
    const auto costs = contest(
        rounds,
        {{"fused, padded",
          [&] { in_bands(threads, kHeight, [&](int a, int b) { level.band<false>(in, guides, out, step, a, b); }); }},
         {"fused, with borders",
          [&] { in_bands(threads, kHeight, [&](int a, int b) { level.band<true>(in, guides, out, step, a, b); }); }},
         graph.contestant("graph")});
    for (std::size_t k = 0; k < 3; ++k) sums[k] += costs[k].wall;
  }
  std::printf(" five levels, wall: padded %.1f ms, with borders %.1f ms, graph %.1f ms: %.3f and %.3f times\n",
              sums[0] * 1e3, sums[1] * 1e3, sums[2] * 1e3, sums[2] / sums[0], sums[2] / sums[1]);
}

}  // namespace

int main(int argc, char** argv) {
  if (!__builtin_cpu_supports("avx512dq")) return std::puts("needs a machine with AVX-512"), 1;
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 7;
  flush_denormals();
  band_by_band(rounds);
  for (const int threads : {1, 2}) on_the_host(rounds, threads);
}
#else
int main() { return std::puts("built without AVX-512: nothing to compare with"), 1; }
#endif
