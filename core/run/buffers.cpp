// The memory of a run.
#include "core/run/buffers.h"

#include "core/image/image.h"
#include "core/report/error.h"

#include <fmt/format.h>

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace quell {

void Buffers::Free::operator()(float* p) const { std::free(p); }

Buffers::Memory Buffers::allocate(std::size_t floats) {
  const std::size_t bytes = std::max<std::size_t>(64, floats * sizeof(float));
  constexpr std::size_t huge = std::size_t(2) << 20;
  const std::size_t align = bytes >= huge ? huge : 64;
  Memory memory(static_cast<float*>(std::aligned_alloc(align, (bytes + align - 1) / align * align)));
  if (!memory) throw Error(Exit::resources, fmt::format("cannot allocate {} MiB for images", bytes >> 20));
  if (bytes >= huge) madvise(memory.get(), bytes, MADV_HUGEPAGE);
  // Margins may be read, so they must hold numbers once; and the pages are touched before the first frame is timed.
  std::memset(memory.get(), 0, bytes);
  return memory;
}

Buffers::Buffers(const Plan& plan) : plan_(&plan), arena_(allocate(plan.arena_floats())) {
  for (const auto& v : plan.values()) {
    auto& slots = planes_.emplace_back();
    if (!v.exists || v.local) continue;
    if (v.slots == 0) {
      lay_out(arena_.get() + v.offset, v.shape, slots.emplace_back());
      continue;
    }
    auto& ring = rings_.emplace_back(allocate(v.floats * std::size_t(v.slots)));
    for (int s = 0; s < v.slots; ++s) lay_out(ring.get() + v.floats * std::size_t(s), v.shape, slots.emplace_back());
  }
}

quell_image Buffers::image(std::size_t value, std::int64_t ordinal, int delay) const {
  const auto& v = plan_->values()[value];
  if (!v.exists) return {};
  const std::int64_t slots = std::max(1, v.slots);
  const auto slot = std::size_t(((ordinal - delay) % slots + slots) % slots);
  return {planes_[value][slot].data(), v.shape.width, v.shape.height, v.shape.channels, 0, pitch_for(v.shape.width)};
}

void Buffers::forget(std::int64_t ordinal) {
  for (std::size_t i = 0; i < planes_.size(); ++i)
    for (int k = 1; k <= plan_->values()[i].delay; ++k) fill_missing(image(i, ordinal, k), plan_->values()[i].type);
}

}  // namespace quell
