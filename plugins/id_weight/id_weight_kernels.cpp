// Exponents of id_weight, two vectors of pixels a step.
#include "id_weight/id_weight_kernels.h"

#include <quell/weights.h>

QUELL_SIMD_BEGIN

void weigh(const quell_run& run, const float* id, float* exponent) {
  each(run, exponent, [=](auto p) HWY_ATTR {
    const I here = hn::BitCast(di, p(id));
    return [=](auto q) HWY_ATTR {
      const M same = hn::RebindMask(d, hn::BitCast(di, q(id)) == here);
      return hn::IfThenZeroElse(same, all(HUGE_VALF));
    };
  });
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(weigh);
void id_weigh(const quell_run& run, const float* id, float* exponent) {
  HWY_DYNAMIC_DISPATCH(weigh)(run, id, exponent);
}

}  // namespace quell
#endif
