// Gathers young pixels by the strides of their ages.
#include "history_fix/history_fix_kernels.h"

#include <quell/gather.h>

QUELL_SIMD_BEGIN

// Young pixels line the edges of what moved, so they are looked for in blocks of what weight nodes step by at least.
constexpr int kBlock = 32;

// The strides that the young pixels of a block ask for, as a set of bits; 0 where there are none.
inline std::uint64_t strides_of(const HistoryFix& f, std::ptrdiff_t at, int n) {
  std::uint64_t set = 0;
  for (int i = 0; i < n; ++i)
    if (f.count[at + i] <= f.frames) set |= std::uint64_t{1} << fix_stride(f.stride, f.count[at + i]);
  return set;
}

// Means of the block's taps at one stride, to the pixels whose stride that is.
inline void put_stride(const HistoryFix& f, int stride, Sums& sums, const quell_image& out, std::ptrdiff_t at, int n) {
  for (int i = 0; i < n; ++i) {
    if (f.count[at + i] > f.frames || fix_stride(f.stride, f.count[at + i]) != stride) continue;
    for (int c = 0; c < out.channels; ++c) out.plane[c][at + i] = sums.plane(std::size_t(c))[i] / sums.weight()[i];
  }
}

void fix(const HistoryFix& f, const quell_tile& tile, const quell_image& out) {
  Sums sums(std::size_t(f.image.channels));
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; x += kBlock) {
      const int n = x + kBlock < tile.x1 ? kBlock : tile.x1 - x;
      const std::ptrdiff_t at = y * f.image.pitch + x;
      for (int c = 0; c < out.channels; ++c)
        for (int i = 0; i < n; i += kLanes) store(load(f.image.plane[c] + at + i), out.plane[c] + at + i, n - i);
      const std::uint64_t wanted = strides_of(f, at, n);
      for (int s = 1; wanted >> s; ++s) {
        if (!(wanted >> s & 1)) continue;
        gather(gather_of(f.taps[std::size_t(s)], f.weights, f.image), x, y, n, sums);
        put_stride(f, s, sums, out, at, n);
      }
    }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(fix);
void fix_tile(const HistoryFix& f, const quell_tile& tile, const quell_image& out) {
  HWY_DYNAMIC_DISPATCH(fix)(f, tile, out);
}

}  // namespace quell
#endif
