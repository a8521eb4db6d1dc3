// Runs the gather engine for window.
#include "window/window_kernels.h"

#include <quell/gather.h>

QUELL_SIMD_BEGIN
void all_taps(const Gather& g, const quell_tile& tile, const quell_image& out) {
  gather_tile(g, tile, 1, out, nullptr);
}
QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(all_taps);
void window_tile(const Gather& g, const quell_tile& tile, const quell_image& out) {
  HWY_DYNAMIC_DISPATCH(all_taps)(g, tile, out);
}

}  // namespace quell
#endif
