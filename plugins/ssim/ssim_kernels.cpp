// Structural similarity along rows: down the columns first, then along the row.
#include "ssim/ssim_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

// In double: E[x²] − E[x]² of a flat part is what rounding left, which C2 is to outweigh.
using D = hn::ScalableTag<double>;
using W = hn::Vec<D>;
constexpr D dd;
constexpr hn::Rebind<float, D> df;
constexpr int kWide = int(hn::MaxLanes(dd));

HWY_INLINE W both(double value) { return hn::Set(dd, value); }
HWY_INLINE W widened(const float* from) { return hn::PromoteTo(dd, hn::LoadU(df, from)); }
HWY_INLINE void narrowed(W v, float* to, int count) {
  const auto narrow = hn::DemoteTo(df, v);
  if (count >= kWide)
    hn::StoreU(narrow, df, to);
  else
    hn::BlendedStore(narrow, hn::FirstN(df, std::size_t(count)), df, to);
}

// Means of what.
enum { kX, kY, kXX, kYY, kXY, kMeans };
// (K L)² with K1 = 0.01, K2 = 0.03 and L = 1.
constexpr double kC1 = 1e-4, kC2 = 9e-4;

// Numbers from the means of one to those of the next; vectors may be stored past the last.
int stride_of(int x0, int x1) { return x1 - x0 + 2 * kSsimRadius + kWide; }

// Columns `from` to `to`, which lie in the image, to `out`.
void down_columns(const SsimRow& r, int from, int to, double* out, int stride) {
  for (int x = from; x < to; x += kWide, out += kWide) {
    W mean[kMeans] = {both(0), both(0), both(0), both(0), both(0)};
    for (int k = 0; k < kSsimTaps; ++k) {
      const W w = both(r.weight[k]), a = widened(r.image[k] + x), b = widened(r.reference[k] + x);
      const W wa = w * a, wb = w * b;
      mean[kX] = mean[kX] + wa;
      mean[kY] = mean[kY] + wb;
      mean[kXX] = hn::MulAdd(wa, a, mean[kXX]);
      mean[kYY] = hn::MulAdd(wb, b, mean[kYY]);
      mean[kXY] = hn::MulAdd(wa, b, mean[kXY]);
    }
    for (int m = 0; m < kMeans; ++m) hn::StoreU(mean[m], dd, out + m * stride);
  }
}

void row_of_similarity(const SsimRow& r, double* scratch, float* similarity, float* contrast) {
  const int stride = stride_of(r.x0, r.x1), left = r.x0 - kSsimRadius, right = r.x1 + kSsimRadius;
  const int from = left < 0 ? 0 : left, to = right > r.width ? r.width : right;
  down_columns(r, from, to, scratch + (from - left), stride);
  // Columns outside the image are those at its border.
  for (int m = 0; m < kMeans; ++m) {
    double* const row = scratch + m * stride;
    for (int i = 0; i < from - left; ++i) row[i] = row[from - left];
    for (int i = to - left; i < right - left; ++i) row[i] = row[to - left - 1];
  }
  for (int x = r.x0; x < r.x1; x += kWide) {
    W mean[kMeans] = {both(0), both(0), both(0), both(0), both(0)};
    for (int k = 0; k < kSsimTaps; ++k)
      for (int m = 0; m < kMeans; ++m)
        mean[m] = hn::MulAdd(both(r.weight[k]), hn::LoadU(dd, scratch + m * stride + (x - r.x0) + k), mean[m]);
    const W ux = mean[kX], uy = mean[kY], uxy = ux * uy;
    const W xy = mean[kXY] - uxy;
    const W squares = hn::Max((mean[kXX] - ux * ux) + (mean[kYY] - uy * uy), both(0));
    const W cs = (xy + xy + both(kC2)) / (squares + both(kC2));
    const W l = (uxy + uxy + both(kC1)) / ((ux * ux + uy * uy) + both(kC1));
    const W so_far = r.first ? both(0) : widened(similarity + x), so_far_cs = r.first ? both(0) : widened(contrast + x);
    narrowed(hn::MulAdd(both(r.share), l * cs, so_far), similarity + x, r.x1 - x);
    narrowed(hn::MulAdd(both(r.share), cs, so_far_cs), contrast + x, r.x1 - x);
  }
}

// Vectors read past the last of the sums, so there must be something.
int scratch_numbers(int x0, int x1) { return kMeans * stride_of(x0, x1) + kWide; }

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(row_of_similarity);
HWY_EXPORT(scratch_numbers);

int ssim_scratch(int x0, int x1) { return HWY_DYNAMIC_DISPATCH(scratch_numbers)(x0, x1); }
void ssim_row(const SsimRow& row, double* scratch, float* similarity, float* contrast) {
  HWY_DYNAMIC_DISPATCH(row_of_similarity)(row, scratch, similarity, contrast);
}

}  // namespace quell
#endif
