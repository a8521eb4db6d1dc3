// A wide blur: the graph of two separable passes, and the gaussian node, against OpenCV's GaussianBlur. Sigma 8, 49
// taps a pass, 1080p of three channels, in turn in one process; graphs on the host's executor.
#include "tests/bench/host_graph.h"
#include "tests/bench/turns.h"

#ifdef QUELL_BENCH_OPENCV
#include "tests/bench/opencv.h"
#endif

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using namespace quell::bench;

constexpr int kWidth = 1920, kHeight = 1080, kRadius = 24;

void blur(int rounds, int threads) {
  std::printf("%d thread%s\n", threads, threads > 1 ? "s" : "");
  const std::string radius = std::to_string(kRadius);
  HostGraph passes(load("separable_gaussian", {"sigma=8", "radius=" + radius}), kWidth, kHeight, threads),
      node(load("gaussian", {"sigma=8"}), kWidth, kHeight, threads);
  std::vector<Contestant> all;
#ifdef QUELL_BENCH_OPENCV
  cv::setNumThreads(threads);
  const cv::Mat in = interleaved(passes.inputs()[0]);
  cv::Mat out;
  all.push_back({"OpenCV GaussianBlur", [&] { cv::GaussianBlur(in, out, {2 * kRadius + 1, 2 * kRadius + 1}, 8); }});
#else
  std::puts("  built without OpenCV: nothing to compare with");
#endif
  all.push_back(passes.contestant("separable_gaussian"));
  all.push_back(node.contestant("gaussian"));
  contest(rounds, all);
#ifdef QUELL_BENCH_OPENCV
  std::printf("  largest difference inside: %.1e and %.1e\n", largest_difference(passes.outputs()[0], out, kRadius),
              largest_difference(node.outputs()[0], out, kRadius));
#endif
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 9;
  for (const int threads : {1, 2}) blur(rounds, threads);
}
