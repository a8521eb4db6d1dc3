// The memory of a run: one arena for what lives within a frame, and a ring for each value that outlives it.
#pragma once

#include "core/run/plan.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace quell {

class Buffers {
 public:
  explicit Buffers(const Plan&);

  // The image of a value `delay` frames before frame number `ordinal` of this plan.
  quell_image image(std::size_t value, std::int64_t ordinal, int delay) const;

  // Makes every delayed value read as missing from `ordinal` on.
  void forget(std::int64_t ordinal);

 private:
  struct Free {
    void operator()(float* p) const;
  };
  using Memory = std::unique_ptr<float, Free>;
  static Memory allocate(std::size_t floats);

  const Plan* plan_;
  Memory arena_;
  std::vector<Memory> rings_;
  std::vector<std::vector<std::vector<float*>>> planes_;  // by value and slot
};

}  // namespace quell
