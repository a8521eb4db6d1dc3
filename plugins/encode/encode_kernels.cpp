// Transfer curves over rows.
#include "encode/encode_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

// The largest half, which the PU curve maps to 1.
constexpr float kMost = 65504.0f;
// Of Open Image Denoise's transfer function: a line, a power and a logarithm, and what brings its end to 1.
constexpr float kA = 1412.83765f, kB = 1.64593172f, kC = 0.431384981f, kD = -0.00294139609f;
constexpr float kE = 0.192653254f, kF = 0.00626026094f, kG = 0.998620152f;
constexpr float kY0 = 1.57945760e-06f, kY1 = 0.0322087631f, kNorm = 0.318967155f;
constexpr float kLn2 = 0.6931471805599453f;

HWY_INLINE V pu(V y) {
  const V line = all(kA) * y;
  const V power = mul_add(all(kB), exp2(log2(hn::Max(y, all(kY0))) * all(kC)), all(kD));
  const V log = mul_add(all(kE * kLn2), log2(y + all(kF)), all(kG));
  const V curve = hn::IfThenElse(y <= all(kY0), line, hn::IfThenElse(y <= all(kY1), power, log));
  return curve * all(kNorm);
}

void compress_row(int x0, int x1, const float* in, float* out) {
  for (int x = x0; x < x1; x += kLanes) {
    const V v = hn::Max(load(in + x), zero());
    store(v / (v + all(1.0f)), out + x, x1 - x);
  }
}

void pu_row(int x0, int x1, const float* in, float* out) {
  for (int x = x0; x < x1; x += kLanes) store(pu(hn::Min(hn::Max(load(in + x), zero()), all(kMost))), out + x, x1 - x);
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(compress_row);
HWY_EXPORT(pu_row);

void encode_row(Curve curve, int x0, int x1, const float* in, float* out) {
  if (curve == Curve::compress) return HWY_DYNAMIC_DISPATCH(compress_row)(x0, x1, in, out);
  HWY_DYNAMIC_DISPATCH(pu_row)(x0, x1, in, out);
}

}  // namespace quell
#endif
