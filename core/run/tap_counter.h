// Counts the taps of filters, by listening to what they ask weight nodes.
//
// A filter says in each call of a weight node for how many pixels and taps it wants exponents, so their number is known
// without the filter's help: of windows of any shape, and none where a filter found nothing to do. Filters that list no
// weight node are not heard.
#pragma once

#include <quell/abi.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>

namespace quell {

class TapCounter {
 public:
  explicit TapCounter(std::size_t nodes) : filters_(nodes) {}

  // While this is false, nothing is counted and nothing costs time.
  bool on = false;

  // What a filter is given in place of the first weight node that it lists.
  quell_bound_weight listen(std::size_t node, const quell_bound_weight& weight) {
    filters_[node].weight = weight;
    return {&count, &filters_[node], nullptr, weight.in};
  }
  // Pixels × taps so far.
  std::uint64_t taps(std::size_t node) const { return filters_[node].taps.load(); }

 private:
  struct Filter {
    quell_bound_weight weight{};
    mutable std::atomic<std::uint64_t> taps{0};
  };
  static void count(const void* instance, const void*, const quell_input* in, const quell_run* run, float* exponent) {
    const auto& filter = *static_cast<const Filter*>(instance);
    filter.taps.fetch_add(std::uint64_t(run->n) * std::uint64_t(run->taps), std::memory_order_relaxed);
    filter.weight.weigh(filter.weight.instance, filter.weight.resource, in, run, exponent);
  }

  std::deque<Filter> filters_;
};

}  // namespace quell
