// Each plugin by itself, from its table alone, at its defaults on one thread: 1920x1080 of what `quell bench` makes.
//
// A filter that takes weight nodes has two rows, without any and under normal_weight and depth_weight; a weight node is
// asked about the taps of a 5x5 window, segment by segment, as a filter would. Items are pixels, and those taps for a
// weight node. Options are Google Benchmark's: --benchmark_filter=atrous.
#include "core/bench/synthetic_source.h"
#include "tests/bench/turns.h"
#include "tests/contract/use.h"
#include "tests/support/run_node.h"

#include <benchmark/benchmark.h>
#include <quell/taps.h>
#include <quell/types.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace {

using quell::Image;
using quell::NodeType;
using quell::test::Bound;
using quell::test::Use;

constexpr int kWidth = 1920, kHeight = 1080;

// Images of a picture that hangs together, in place of the noise that tests take.
void show_the_picture(Use& use) {
  for (auto& port : use.in) {
    int take = 0;
    for (auto& image : port.images) image = quell::synthetic_image(port.type, kWidth, kHeight, take++ % 2);
    for (auto& weight : port.weights) show_the_picture(weight);
  }
}

std::unique_ptr<Use> use_of(const NodeType& type, bool weighed) {
  quell::test::Choices choices;
  choices.width = choices.height = 1;  // what is made for tests is thrown away
  if (weighed)
    for (const char* name : {"normal_weight", "depth_weight"})
      choices.weights.push_back(quell::test::registry().find(name));
  auto use = std::make_unique<Use>(type, choices);
  show_the_picture(*use);
  return use;
}

void run_node(benchmark::State& state, const NodeType& type, bool weighed) {
  const auto use = use_of(type, weighed);
  const Bound bound(*use);
  std::vector<Image> images;
  std::vector<quell_image> out;
  for (std::size_t o = 0; o < bound.shapes().size(); ++o) {
    images.emplace_back(bound.exists(int(o)) ? Image(bound.shapes()[o]) : Image());
    out.push_back(images.back().empty() ? quell_image{} : images.back().view());
  }
  const auto extent = bound.extent();
  quell::bench::flush_denormals();
  for (auto _ : state) bound.run({0, 0, extent.width, extent.height}, 1, out);
  state.SetItemsProcessed(std::int64_t(state.iterations()) * extent.width * extent.height);
}

void weigh(benchmark::State& state, const NodeType& type) {
  const auto use = use_of(type, false);
  const Bound bound(*use);
  constexpr std::ptrdiff_t kRow = QUELL_SEGMENT + 16;
  alignas(64) static float exponent[QUELL_MAX_TAPS * kRow];
  const std::ptrdiff_t pitch = quell::pitch_for(kWidth);
  const auto taps = quell::square_taps(2, 1, pitch, [](int, int) { return 1.0; });
  const int count = int(taps.tap.size());
  quell::bench::flush_denormals();
  for (auto _ : state)
    for (int y = 2; y < kHeight - 2; ++y)
      for (int x = 0; x < kWidth; x += QUELL_SEGMENT) {
        const quell_run run{x, y, QUELL_SEGMENT, count, taps.tap.data(), y * pitch + x, kRow, 1, 1};
        bound.weigh(run, exponent);
        benchmark::DoNotOptimize(exponent[0]);
      }
  state.SetItemsProcessed(std::int64_t(state.iterations()) * (kHeight - 4) * kWidth * count);
}

}  // namespace

int main(int argc, char** argv) {
  for (const auto* type : quell::test::registry().all()) {
    const std::string name(type->name());
    const auto add = [](const std::string& row, auto run) {
      benchmark::RegisterBenchmark(row.c_str(), run)->Unit(benchmark::kMillisecond);
    };
    if (type->is_weight()) {
      add(name, [type](benchmark::State& state) { weigh(state, *type); });
      continue;
    }
    if (type->inputs().empty()) continue;  // a source of frames: what it costs is its scene's
    add(name, [type](benchmark::State& state) { run_node(state, *type, false); });
    for (const auto& port : type->inputs())
      if (port.type == QUELL_WEIGHT)
        add(name + "/weighed", [type](benchmark::State& state) { run_node(state, *type, true); });
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
