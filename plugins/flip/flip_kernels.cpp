// The steps of FLIP along rows.
#include "flip/flip_kernels.h"

#include "tonemap/tone_curve.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

// Radiance is held below this before a curve, as FLIP does.
constexpr float kMost = 65536.0f;
// The colour difference of green and blue to the power of 0.7, the largest there is; differences up to 0.4 of it take
// up 0.95 of the scale, and what is beyond the rest (Andersson et al. 2020, eq. 14).
constexpr float kLargest = 41.276099f, kExponent = 0.7f, kCompressAt = 0.4f, kCompressTo = 0.95f;
// L* = 116 f − 16, and f is a line below its knee δ³ with δ = 6/29.
constexpr float kKnee = 216.0f / 24389.0f, kSlope = 841.0f / 108.0f, kOffset = 4.0f / 29.0f;
constexpr float kRootOfHalf = 0.70710678f;

struct Three {
  V a, b, c;
};

HWY_INLINE Three times(const float* m, Three v) {
  return {mul_add(all(m[0]), v.a, mul_add(all(m[1]), v.b, all(m[2]) * v.c)),
          mul_add(all(m[3]), v.a, mul_add(all(m[4]), v.b, all(m[5]) * v.c)),
          mul_add(all(m[6]), v.a, mul_add(all(m[7]), v.b, all(m[8]) * v.c))};
}

HWY_INLINE V clamped(V v) { return hn::Min(hn::Max(v, zero()), all(1.0f)); }

// x^p for x >= 0 and p > 0.
HWY_INLINE V power(V x, V p) { return hn::IfThenElseZero(x > zero(), exp2_or_zero(log2(x) * p)); }

// The cube root of x in (0, 2], to the last bits: a* and b* are differences of such roots.
HWY_INLINE V cube_root(V x) {
  const V t = exp2(log2(x) * all(1.0f / 3.0f));
  const V square = t * t;
  return t - (square * t - x) / (all(3.0f) * square);
}

HWY_INLINE V lab_curve(V t) {
  return hn::IfThenElse(t > all(kKnee), cube_root(hn::Max(t, all(kKnee))), mul_add(t, all(kSlope), all(kOffset)));
}

void opponent_row(const FlipFilters& f, FlipExposure e, const float* const* rgb, int x0, int x1, float* const* out) {
  const auto& aces = tone::kAces;
  for (int x = x0; x < x1; x += kLanes) {
    V v[3];
    for (int c = 0; c < 3; ++c) {
      v[c] = hn::Min(hn::Max(load(rgb[c] + x), zero()), all(kMost)) * all(e.gain);
      if (e.aces) {
        v[c] = hn::Min(v[c], all(kMost));
        const V over = mul_add(mul_add(v[c], all(aces.over_square), all(aces.over_linear)), v[c], all(aces.over_one));
        v[c] = mul_add(v[c], all(aces.square), all(aces.linear)) * v[c] / over;
      }
      v[c] = clamped(v[c]);
    }
    const Three xyz = times(f.to_xyz, {v[0], v[1], v[2]});
    const int at = x - x0, left = x1 - x;
    store(mul_add(all(116.0f), xyz.b, all(-16.0f)), out[0] + at, left);
    store(all(500.0f) * (xyz.a - xyz.b), out[1] + at, left);
    store(all(200.0f) * (xyz.b - xyz.c), out[2] + at, left);
  }
}

void along_row(const float* in, const float* weight, int taps, int n, float* out) {
  for (int i = 0; i < n; i += kLanes) {
    V sum = zero();
    for (int k = 0; k < taps; ++k) sum = mul_add(load(in + i + k), all(weight[k]), sum);
    store(sum, out + i);
  }
}

void down_rows(const float* in, std::ptrdiff_t stride, const float* weight, int taps, int n, float* out, bool add) {
  for (int i = 0; i < n; i += kLanes) {
    V sum = add ? load(out + i) : zero();
    for (int k = 0; k < taps; ++k) sum = mul_add(load(in + k * stride + i), all(weight[k]), sum);
    store(sum, out + i);
  }
}

HWY_INLINE V length(const float* x, const float* y, int i) {
  const V a = load(x + i), b = load(y + i);
  return hn::Sqrt(a * a + b * b) * all(1.0f / 116.0f);  // they were found in 116 Y − 16
}

// One function for both images, so that equal pixels come to equal numbers whatever the compiler joins and splits. a*
// and b* fade with L* as the eye's sense of colour does (Hunt).
void seen_row(const FlipFilters& f, const FlipFiltered& row, int n, const FlipSeen& out) {
  for (int i = 0; i < n; i += kLanes) {
    const V y = (load(row.lightness + i) + all(16.0f)) * all(1.0f / 116.0f);
    const V x = mul_add(load(row.red_green + i), all(1.0f / 500.0f), y);
    const V z = y - load(row.blue_yellow + i) * all(1.0f / 200.0f);
    const Three rgb = times(f.to_rgb, {x, y, z});
    const Three xyz = times(f.to_xyz, {clamped(rgb.a), clamped(rgb.b), clamped(rgb.c)});
    const V fx = lab_curve(xyz.a), fy = lab_curve(xyz.b), fz = lab_curve(xyz.c);
    const V l = mul_add(all(116.0f), fy, all(-16.0f)), fade = all(0.01f) * l;
    store(l, out.l + i);
    store(fade * all(500.0f) * (fx - fy), out.a + i);
    store(fade * all(200.0f) * (fy - fz), out.b + i);
    store(length(row.edge_x, row.edge_y, i), out.edge + i);
    store(length(row.point_x, row.point_y, i), out.point + i);
  }
}

HWY_INLINE V apart(const float* p, const float* q, int i) { return hn::Abs(load(p + i) - load(q + i)); }

HWY_INLINE V color_error(const FlipSeen& p, const FlipSeen& q, int i) {
  const V da = apart(p.a, q.a, i), db = apart(p.b, q.b, i);
  const V e = power(apart(p.l, q.l, i) + hn::Sqrt(da * da + db * db), all(kExponent));
  constexpr float knee = kCompressAt * kLargest;
  const V low = e * all(kCompressTo / knee);
  const V high = mul_add(e - all(knee), all((1 - kCompressTo) / (kLargest - knee)), all(kCompressTo));
  return clamped(hn::IfThenElse(e < all(knee), low, high));
}

HWY_INLINE V feature_error(const FlipSeen& p, const FlipSeen& q, int i) {
  const V most = hn::Max(apart(p.edge, q.edge, i), apart(p.point, q.point, i));
  return hn::Sqrt(hn::Min(most * all(kRootOfHalf), all(1.0f)));
}

void error_row(const FlipSeen& p, const FlipSeen& q, int n, float* out, bool first) {
  for (int i = 0; i < n; i += kLanes) {
    const V color = color_error(p, q, i), exponent = all(1.0f) - feature_error(p, q, i);
    // 0^0 is 1: where a feature differs as much as one can, so does the pixel.
    const V e = hn::IfThenElse(exponent > zero(), power(color, exponent), all(1.0f));
    store(clamped(first ? e : hn::Max(e, load(out + i))), out + i, n - i);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(opponent_row);
HWY_EXPORT(along_row);
HWY_EXPORT(down_rows);
HWY_EXPORT(seen_row);
HWY_EXPORT(error_row);

void flip_opponent(const FlipFilters& f, FlipExposure e, const float* const rgb[3], int x0, int x1,
                   float* const out[3]) {
  HWY_DYNAMIC_DISPATCH(opponent_row)(f, e, rgb, x0, x1, out);
}
void flip_along(const float* in, const float* weight, int taps, int n, float* out) {
  HWY_DYNAMIC_DISPATCH(along_row)(in, weight, taps, n, out);
}
void flip_down(const float* in, std::ptrdiff_t stride, const float* weight, int taps, int n, float* out, bool add) {
  HWY_DYNAMIC_DISPATCH(down_rows)(in, stride, weight, taps, n, out, add);
}
void flip_seen(const FlipFilters& f, const FlipFiltered& row, int n, const FlipSeen& out) {
  HWY_DYNAMIC_DISPATCH(seen_row)(f, row, n, out);
}
void flip_error(const FlipSeen& image, const FlipSeen& reference, int n, float* out, bool first) {
  HWY_DYNAMIC_DISPATCH(error_row)(image, reference, n, out, first);
}

}  // namespace quell
#endif
