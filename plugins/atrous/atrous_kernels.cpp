// Runs the gather engine for atrous.
#include "atrous/atrous_kernels.h"

#include <quell/gather.h>

QUELL_SIMD_BEGIN
void level(const Gather& g, const quell_tile& tile, int step, const quell_image& out, float* variance) {
  gather_tile(g, tile, step, out, variance);
}
QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(level);
void atrous_tile(const Gather& g, const quell_tile& tile, int step, const quell_image& out, float* out_variance) {
  HWY_DYNAMIC_DISPATCH(level)(g, tile, step, out, out_variance);
}

}  // namespace quell
#endif
