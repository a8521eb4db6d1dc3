// Fewer frames in flight where memory is short.
#include "core/run/memory_limit.h"

#include "core/report/error.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace quell {

namespace {

std::string largest_buffers(const Plan& plan) {
  constexpr std::size_t kShown = 5;
  std::vector<const PlannedValue*> buffers;
  for (const auto& v : plan.values())
    if (v.exists && !v.local) buffers.push_back(&v);
  std::ranges::stable_sort(buffers, std::greater(), [](const auto* v) { return v->bytes(); });
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, buffers.size()); ++i) {
    const auto& v = *buffers[i];
    text += fmt::format("\n  {}: {} ({} {}x{}x{}, {})", v.name, size_text(v.bytes()), type_name(v.type), v.shape.width,
                        v.shape.height, v.shape.channels, place_of(v));
  }
  return text;
}

}  // namespace

std::string size_text(std::size_t bytes) {
  const double kib = double(bytes) / 1024;
  return kib < 1024 ? fmt::format("{:.1f} KiB", kib) : fmt::format("{:.1f} MiB", kib / 1024);
}

Plan plan_within(const Graph& graph, std::span<const quell_shape> inputs, Overlap wanted, std::size_t max_memory) {
  for (const auto& [reading, writing] : {Overlap{true, true}, {true, false}, {false, true}}) {
    if ((reading && !wanted.reading) || (writing && !wanted.writing)) continue;
    Plan plan(graph, inputs, {reading, writing});
    if (!max_memory || plan.bytes() <= max_memory) return plan;
  }
  Plan plan(graph, inputs, {false, false});
  if (!max_memory || plan.bytes() <= max_memory) return plan;
  const double gib = 1024.0 * 1024 * 1024;
  throw Error(Exit::resources,
              fmt::format("the images of one frame need {}, but the limit is {}; the largest buffers:{}\n  "
                          "raise --max-memory to {:.3f} (GiB), or use smaller frames",
                          size_text(plan.bytes()), size_text(max_memory), largest_buffers(plan),
                          std::ceil(double(plan.bytes()) / gib * 1000) / 1000));
}

}  // namespace quell
