// Runs the gather engine for separable.
#include "separable/separable_kernels.h"

#include <quell/gather.h>

QUELL_SIMD_BEGIN
void pass(const Gather& g, const quell_tile& tile, const quell_image& out) { gather_tile(g, tile, 1, out, nullptr); }
QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(pass);
void separable_tile(const Gather& g, const quell_tile& tile, const quell_image& out) {
  HWY_DYNAMIC_DISPATCH(pass)(g, tile, out);
}

}  // namespace quell
#endif
