// Windows with weights against three opponents, in turn in one process; graphs on the host's executor, 1080p.
//
// Radius 7 with a colour weight against OpenCV's bilateralFilter of d = 15, over the same disc of 149 taps and over the
// whole square of 225. The sigmas are the same, but OpenCV takes the sum of the channels' differences for their
// distance and looks exp up in a table, so its picture is another.
//
// Radius 16 with the weights of graphs/games202.json (distance, colour, angle of normals, tangent plane) against the
// same filter fused by hand for AVX-512, and against plain loops with std::acos and std::exp. The plain loops run on a
// strip in the middle of the picture, for they are slow, and are compared by the pixel. The largest differences are
// printed: all three compute one thing.
#include "tests/bench/fused_window.h"
#include "tests/bench/host_graph.h"
#include "tests/bench/naive_window.h"
#include "tests/bench/turns.h"

#ifdef QUELL_BENCH_OPENCV
#include "tests/bench/opencv.h"
#endif

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace quell::bench;

constexpr int kWidth = 1920, kHeight = 1080, kStrip = 16;

void bilateral(int rounds, int threads) {
  std::printf("%d thread%s, radius 7, colour\n", threads, threads > 1 ? "s" : "");
  const std::vector<std::string> set{"radius=7", "sigma=4", "sigma_color=0.6", "filter.shape=disc"};
  HostGraph disc(load("bilateral", set), kWidth, kHeight, threads),
      square(load("bilateral", {set.begin(), set.begin() + 3}), kWidth, kHeight, threads);
  std::vector<Contestant> all{disc.contestant("bilateral, disc"), square.contestant("bilateral, square")};
#ifdef QUELL_BENCH_OPENCV
  cv::setNumThreads(threads);
  const cv::Mat in = interleaved(disc.inputs()[0]);
  cv::Mat out;
  all.push_back({"OpenCV bilateralFilter", [&] { cv::bilateralFilter(in, out, 15, 0.6, 4); }});
#else
  std::puts("  built without OpenCV: nothing to compare with");
#endif
  contest(rounds, all);
}

constexpr const char* kWindow = R"({
  "quell": 1, "name": "Window of GAMES202",
  "inputs": { "color": "radiance", "normal": "normal", "position": "position" },
  "nodes": {
    "by_color":  { "type": "color_weight", "in": { "image": "color" }, "set": { "sigma": 0.6 } },
    "by_normal": { "type": "normal_weight", "in": { "normal": "normal" }, "set": { "mode": "angle", "sigma": 0.1 } },
    "by_plane":  { "type": "plane_weight", "in": { "normal": "normal", "position": "position" }, "set": { "sigma": 0.1 } },
    "filtered":  { "type": "window", "set": { "radius": 16, "sigma": 32 },
                   "in": { "image": "color", "weights": ["by_color", "by_normal", "by_plane"] } }
  },
  "outputs": { "color": "filtered" }
})";

// Largest difference in rows [y0, y1); at(channel, x, y) gives the other picture.
template <class Other>
double difference(const quell_image& image, int y0, int y1, Other at) {
  double most = 0;
  for (int c = 0; c < image.channels; ++c)
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < image.width; ++x)
        most = std::max(most, std::abs(double(image.plane[c][y * image.pitch + x]) - double(at(c, x, y))));
  return most;
}

void of_games202(int rounds, int threads) {
  std::printf("%d thread%s, radius 16, four weights\n", threads, threads > 1 ? "s" : "");
  HostGraph graph(load("window.json", {}, kWindow), kWidth, kHeight, threads);
  const auto in = graph.inputs();
  NaiveWindow naive(in[0], in[1], in[2], {});
  constexpr int kFirst = (kHeight - kStrip) / 2;
  std::vector<Contestant> all{graph.contestant("window"), {"plain loops, a strip of 16 rows", [&] {
                                                             in_bands(threads, kStrip, [&](int y0, int y1) {
                                                               naive.band(kFirst + y0, kFirst + y1);
                                                             });
                                                           }}};
#ifdef __AVX512F__
  FusedWindow fused(kWidth, kHeight, {});
  fused.take(in[0], in[1], in[2]);
  all.push_back({"fused", [&] { in_bands(threads, kHeight, [&](int y0, int y1) { fused.band(y0, y1); }); }});
#endif
  const auto costs = contest(rounds, all);
  constexpr double kShare = double(kHeight) / kStrip;
  std::printf(
      "  plain loops, by the pixel: %.2f times the window's wall time, %.2f times its CPU time; largest "
      "difference %.1e\n",
      kShare * costs[1].wall / costs[0].wall, kShare * costs[1].cpu / costs[0].cpu,
      difference(graph.outputs()[0], kFirst, kFirst + kStrip, [&](int c, int x, int y) { return naive.at(c, x, y); }));
#ifdef __AVX512F__
  std::printf(
      "  window: %.3f times the fused one's wall time, %.3f times its CPU time; largest difference %.1e\n",
      costs[0].wall / costs[2].wall, costs[0].cpu / costs[2].cpu,
      difference(graph.outputs()[0], 0, kHeight, [&](int c, int x, int y) { return fused.out().row(c, y)[x]; }));
#else
  std::puts("  built without AVX-512: no fused window to compare with");
#endif
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 3;
  for (const int threads : {1, 2}) bilateral(rounds, threads);
  for (const int threads : {1, 2}) of_games202(rounds, threads);
}
