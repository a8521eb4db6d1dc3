// Runs the gather engine for separable, and convolves where there is nothing to weigh by.
//
// A sum takes its taps in one order wherever it is computed, so what a pixel gets depends on no tile. Taps outside of
// the image are left out of columns, and are zeros in rows.
#include "separable/separable_kernels.h"

#include <quell/gather.h>

QUELL_SIMD_BEGIN

void pass(const Gather& g, const quell_tile& tile, const quell_image& out) { gather_tile(g, tile, 1, out, nullptr); }

constexpr int kVectors = 8, kStep = kVectors * kLanes;  // pixels of a row that are summed together
static_assert(kStep <= Convolution::kPad);

// Adds kTaps taps that lie a vector apart: what is loaded for a tap of one vector serves the next tap of the vector
// before. Loads at odd places are what rows cost.
template <int kTaps>
HWY_INLINE void add_taps(const float* kernel, const float* from, V (&sum)[kVectors]) {
  V w[kTaps];
#pragma GCC unroll 4
  for (int j = 0; j < kTaps; ++j) w[j] = all(kernel[j * kLanes]);
#pragma GCC unroll 12
  for (int t = 0; t < kVectors + kTaps - 1; ++t) {
    const V v = load(from + t * kLanes);
#pragma GCC unroll 4
    for (int j = 0; j < kTaps; ++j)
      if (t - j >= 0 && t - j < kVectors) sum[t - j] = mul_add(w[j], v, sum[t - j]);
  }
}

// `from` is the first tap of the first pixel.
HWY_INLINE void add_along(const Convolution& c, const float* from, V (&sum)[kVectors]) {
  const int taps = 2 * c.radius + 1;
#pragma GCC unroll 8
  for (V& v : sum) v = zero();
  for (int first = 0; first < kLanes && first < taps; ++first)
    for (int k = first; k < taps; k += 4 * kLanes) {
      const float *kernel = c.kernel.data() + k, *at = from + k;
      switch ((taps - k + kLanes - 1) / kLanes) {
        case 1:
          add_taps<1>(kernel, at, sum);
          break;
        case 2:
          add_taps<2>(kernel, at, sum);
          break;
        case 3:
          add_taps<3>(kernel, at, sum);
          break;
        default:
          add_taps<4>(kernel, at, sum);
      }
    }
}

void along_rows(const Convolution& c, const quell_tile& tile, const quell_image& in, const quell_image& out) {
  constexpr int kMostTaps = 2 * 64 + 1;
  HWY_ALIGN float padded[kStep + kMostTaps];
  const int r = c.radius, span = kStep + 2 * r;
  for (int channel = 0; channel < in.channels; ++channel)
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float* const row = in.plane[channel] + y * in.pitch;
      float* const to = out.plane[channel] + y * out.pitch;
      for (int x = tile.x0; x < tile.x1; x += kStep) {
        const float* from = row + x - r;
        if (x < r || x - r + span > in.width) {
          for (int i = 0; i < span; ++i) padded[i] = x - r + i >= 0 && x - r + i < in.width ? from[i] : 0;
          from = padded;
        }
        V sum[kVectors];
        add_along(c, from, sum);
        const float* inverse = c.inverse.data() + (x - tile.x0);
#pragma GCC unroll 8
        for (int i = 0, at = 0; i < kVectors; ++i, at += kLanes)
          if (x + at < tile.x1) store(sum[i] * load(inverse + at), to + x + at, tile.x1 - x - at);
      }
    }
}

// Rows that are summed together, two vectors wide, so that what is loaded serves them all: as many as there are
// registers for.
constexpr int kRows = HWY_TARGET == HWY_AVX3 ? 8 : 4;

// Adds input row `i`, counted from the first tap of the first of the rows, to rows kFirst to kLast.
template <int kFirst, int kLast>
HWY_INLINE void add_row(const float* kernel, const float* from, std::ptrdiff_t pitch, int i, V (&a)[kRows],
                        V (&b)[kRows]) {
  const V va = load(from + i * pitch), vb = load(from + i * pitch + kLanes);
#pragma GCC unroll 8
  for (int row = kFirst; row <= kLast; ++row) {
    const V w = all(kernel[i - row]);
    a[row] = mul_add(w, va, a[row]);
    b[row] = mul_add(w, vb, b[row]);
  }
}
// Input rows before all of the rows have begun, and after some have ended.
template <int kRow = 0>
HWY_INLINE void begin_rows(const float* kernel, const float* from, std::ptrdiff_t pitch, V (&a)[kRows], V (&b)[kRows]) {
  if constexpr (kRow < kRows - 1) {
    add_row<0, kRow>(kernel, from, pitch, kRow, a, b);
    begin_rows<kRow + 1>(kernel, from, pitch, a, b);
  }
}
template <int kRow = 1>
HWY_INLINE void end_rows(const float* kernel, const float* from, std::ptrdiff_t pitch, int last, V (&a)[kRows],
                         V (&b)[kRows]) {
  if constexpr (kRow < kRows) {
    add_row<kRow, kRows - 1>(kernel, from, pitch, last + kRow, a, b);
    end_rows<kRow + 1>(kernel, from, pitch, last, a, b);
  }
}

// kRows rows from y, none with a tap outside of the image.
HWY_INLINE void rows_together(const Convolution& c, const quell_tile& tile, const float* in, std::ptrdiff_t pitch,
                              int y, float* out) {
  const float *const kernel = c.kernel.data(), *const inverse = c.inverse.data() + (y - tile.y0);
  const int last = 2 * c.radius;
  for (int x = tile.x0; x < tile.x1; x += 2 * kLanes) {
    const float* const from = in + (y - c.radius) * pitch + x;
    V a[kRows], b[kRows];
#pragma GCC unroll 8
    for (int row = 0; row < kRows; ++row) a[row] = b[row] = zero();
    begin_rows(kernel, from, pitch, a, b);
    for (int i = kRows - 1; i <= last; ++i) add_row<0, kRows - 1>(kernel, from, pitch, i, a, b);
    end_rows(kernel, from, pitch, last, a, b);
    float* to = out + y * pitch + x;
#pragma GCC unroll 8
    for (int row = 0; row < kRows; ++row, to += pitch) {
      store(a[row] * all(inverse[row]), to, tile.x1 - x);
      if (x + kLanes < tile.x1) store(b[row] * all(inverse[row]), to + kLanes, tile.x1 - x - kLanes);
    }
  }
}

HWY_INLINE void one_row(const Convolution& c, const quell_tile& tile, const quell_image& in, int channel, int y,
                        float* out) {
  const int first = y < c.radius ? 0 : y - c.radius, end = y + c.radius < in.height ? y + c.radius + 1 : in.height;
  const float* const kernel = c.kernel.data() + (first - (y - c.radius));
  const V inverse = all(c.inverse[std::size_t(y - tile.y0)]);
  for (int x = tile.x0; x < tile.x1; x += kLanes) {
    const float* from = in.plane[channel] + first * in.pitch + x;
    V sum = zero();
    for (int k = 0; k < end - first; ++k, from += in.pitch) sum = mul_add(all(kernel[k]), load(from), sum);
    store(sum * inverse, out + x, tile.x1 - x);
  }
}

void along_columns(const Convolution& c, const quell_tile& tile, const quell_image& in, const quell_image& out) {
  const bool many_taps = 2 * c.radius >= kRows - 1;
  for (int channel = 0; channel < in.channels; ++channel) {
    float* const to = out.plane[channel];
    for (int y = tile.y0; y < tile.y1;) {
      if (many_taps && y >= c.radius && y + kRows <= tile.y1 && y + kRows + c.radius <= in.height) {
        rows_together(c, tile, in.plane[channel], in.pitch, y, to);
        y += kRows;
      } else {
        one_row(c, tile, in, channel, y, to + y * out.pitch);
        ++y;
      }
    }
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(pass);
HWY_EXPORT(along_rows);
HWY_EXPORT(along_columns);

void separable_tile(const Gather& g, const quell_tile& tile, const quell_image& out) {
  HWY_DYNAMIC_DISPATCH(pass)(g, tile, out);
}
void convolve_rows(const Convolution& c, const quell_tile& tile, const quell_image& in, const quell_image& out) {
  HWY_DYNAMIC_DISPATCH(along_rows)(c, tile, in, out);
}
void convolve_columns(const Convolution& c, const quell_tile& tile, const quell_image& in, const quell_image& out) {
  HWY_DYNAMIC_DISPATCH(along_columns)(c, tile, in, out);
}

}  // namespace quell
#endif
