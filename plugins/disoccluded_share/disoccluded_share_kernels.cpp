// Counts empty masks along a row.
#include "disoccluded_share/disoccluded_share_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

int empty_masks(const std::uint32_t* mask, int width) {
  const I around = hn::Set(di, std::int32_t(kTapsAround));
  int count = 0;
  for (int x = 0; x < width; x += kLanes) {
    const I bits = hn::LoadU(di, reinterpret_cast<const std::int32_t*>(mask + x)) & around;
    const auto here = hn::FirstN(di, std::size_t(width - x));
    count += int(hn::CountTrue(di, hn::And(hn::Eq(bits, hn::Zero(di)), here)));
  }
  return count;
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(empty_masks);

int count_disoccluded(const std::uint32_t* mask, int width) { return HWY_DYNAMIC_DISPATCH(empty_masks)(mask, width); }

}  // namespace quell
#endif
