// The opponent of weights as nodes: an à-trous level of SVGF fused by hand for AVX-512, that knows its inputs, weights
// and kernel when it is compiled.
//
// One vector of pixels a step (two were slower, for want of registers), one exp2 a tap by vreduceps and vscalefps, the
// normal weight by its series inside of the same exponent, the depth term shared by a tap and its mirror image, rows by
// residue of the step. On what this was measured it is a tenth faster than the usual form that squares the cosine seven
// times.
#pragma once

#include "tests/bench/avx512.h"
#include "tests/bench/padded.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace quell::bench {

struct LevelRule {
  float sigma_luminance = 4, sigma_depth = 1, epsilon = 1e-4f, power = 128;
  bool blur = true;  // steer the luminance weight by the variance smoothed over 3x3, as SVGF does; else by the variance
};

#ifdef __AVX512F__

class FusedLevel {
 public:
  enum { kR, kG, kB, kVariance, kSignal };                    // planes of what is filtered
  enum { kNx, kNy, kNz, kDepth, kSlopeX, kSlopeY, kGuides };  // planes of the guides

  FusedLevel(int width, int height, LevelRule rule) : width_(width), height_(height), rule_(rule) {}

  // kBorders: taps outside of the image do not count, whatever lies there, and the 3x3 is renormalised, as the graph
  // has it. Else the border of zero normals gives taps outside no weight, nothing is checked, and the 3x3 takes zeros.
  template <bool kBorders>
  void band(const Padded& in, const Padded& guides, Padded& out, int step, int y0, int y1) const {
    for (int residue = 0; residue < step; ++residue)
      for (int y = y0 + residue; y < y1; y += step) {
        const Row row = row_at(in, guides, out, step, y);
        if constexpr (kBorders) {
          const int reach = 2 * step, left = std::min(width_, (reach + 15) / 16 * 16),
                    right = std::max(left, (width_ - reach - 16) / 16 * 16);
          if (y < reach || y + reach >= height_) {
            for (int x = 0; x < width_; x += 16) pixels<true>(row, x, y);
          } else {
            for (int x = 0; x < left; x += 16) pixels<true>(row, x, y);
            for (int x = left; x < right; x += 16) pixels<false>(row, x, y);
            for (int x = right; x < width_; x += 16) pixels<true>(row, x, y);
          }
        } else {
          for (int x = 0; x < width_; x += 16) pixels<false>(row, x, y);
        }
      }
  }

 private:
  struct Tap {
    std::ptrdiff_t offset;
    int dx, dy;
    float x, y, log2_kernel;
  };
  struct Row {
    std::array<const float*, kSignal> in;
    std::array<const float*, kGuides> guide;
    std::array<float*, kSignal> out;
    std::ptrdiff_t pitch;
    std::array<Tap, 12> tap;  // the other twelve are their mirror images
  };

  Row row_at(const Padded& in, const Padded& guides, Padded& out, int step, int y) const {
    constexpr float kernel[] = {6 / 16.f, 4 / 16.f, 1 / 16.f};
    Row row{};
    for (int i = 0; i < kSignal; ++i) row.in[std::size_t(i)] = in.row(i, y), row.out[std::size_t(i)] = out.row(i, y);
    for (int i = 0; i < kGuides; ++i) row.guide[std::size_t(i)] = guides.row(i, y);
    row.pitch = in.pitch();
    std::size_t n = 0;
    for (int dy = 0; dy <= 2; ++dy)
      for (int dx = dy ? -2 : 1; dx <= 2; ++dx)
        row.tap[n++] = {(dy * row.pitch + dx) * step,
                        dx * step,
                        dy * step,
                        float(dx * step),
                        float(dy * step),
                        std::log2(kernel[std::abs(dx)] * kernel[dy])};
    return row;
  }

  // Lanes of 16 pixels from x whose neighbour at dx lies in the image.
  __mmask16 columns(int x, int dx) const {
    const __m512i column = _mm512_add_epi32(_mm512_set1_epi32(x + dx),
                                            _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
    return _mm512_cmplt_epu32_mask(column, _mm512_set1_epi32(width_));
  }

  // (1 2 1) x (1 2 1) of the variance.
  static V smooth_variance(const Row& row, int x) {
    const auto along = [](const float* v) { return fma(all(2), load(v), _mm512_add_ps(load(v - 1), load(v + 1))); };
    const float* v = row.in[kVariance] + x;
    const V around = _mm512_add_ps(along(v - row.pitch), along(v + row.pitch));
    return _mm512_mul_ps(all(1 / 16.f), fma(all(2), along(v), around));
  }
  V smooth_variance_inside(const Row& row, int x, int y) const {
    V sum = _mm512_setzero_ps(), weights = sum;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (y + dy < 0 || y + dy >= height_) continue;
        const V k = all(float((2 - std::abs(dx)) * (2 - std::abs(dy))));
        const __mmask16 inside = columns(x, dx);
        sum = _mm512_mask3_fmadd_ps(k, load(row.in[kVariance] + x + dy * row.pitch + dx), sum, inside);
        weights = _mm512_mask_add_ps(weights, inside, weights, k);
      }
    return _mm512_div_ps(sum, weights);
  }

  template <bool kChecked>
  void pixels(const Row& row, int x, int y) const {
    constexpr float centre = 36 / 256.f;
    const float *ir = row.in[kR] + x, *ig = row.in[kG] + x, *ib = row.in[kB] + x, *iv = row.in[kVariance] + x;
    const float *inx = row.guide[kNx] + x, *iny = row.guide[kNy] + x, *inz = row.guide[kNz] + x,
                *iz = row.guide[kDepth] + x;
    const V r = load(ir), g = load(ig), b = load(ib), v = load(iv), l = luminance(r, g, b);
    const V nx = load(inx), ny = load(iny), nz = load(inz), z = load(iz);
    const V sx = load(row.guide[kSlopeX] + x), sy = load(row.guide[kSlopeY] + x);
    const V noise = !rule_.blur ? v : kChecked ? smooth_variance_inside(row, x, y) : smooth_variance(row, x);
    const V by_luminance = _mm512_div_ps(
        all(kLog2E), fma(all(rule_.sigma_luminance), _mm512_sqrt_ps(_mm512_max_ps(noise, all(0))), all(rule_.epsilon)));
    const V c1 = all(-rule_.power * kLog2E), c2 = all(-rule_.power * kLog2E / 2), c3 = all(-rule_.power * kLog2E / 3);
    V sr = _mm512_mul_ps(r, all(centre)), sg = _mm512_mul_ps(g, all(centre)), sb = _mm512_mul_ps(b, all(centre));
    V sv = _mm512_mul_ps(v, all(centre * centre)), sw = all(centre);
    for (const Tap& t : row.tap) {
      const V change = _mm512_abs_ps(fma(sx, all(t.x), _mm512_mul_ps(sy, all(t.y))));
      const V by_depth =
          _mm512_mul_ps(all(kLog2E), _mm512_rcp14_ps(fma(all(rule_.sigma_depth), change, all(rule_.epsilon))));
#pragma GCC unroll 2
      for (const int sign : {1, -1}) {
        if (kChecked && unsigned(y + sign * t.dy) >= unsigned(height_)) continue;
        const std::ptrdiff_t o = sign * t.offset;
        const V qr = load(ir + o), qg = load(ig + o), qb = load(ib + o);
        // -ln(n·n') = u + u²/2 + u³/3 + …
        const V u = _mm512_max_ps(
            all(0), _mm512_fnmadd_ps(load(inx + o), nx,
                                     _mm512_fnmadd_ps(load(iny + o), ny, _mm512_fnmadd_ps(load(inz + o), nz, all(1)))));
        const V by_normal = fma(fma(u, c3, c2), u, c1);
        const V dl = _mm512_abs_ps(_mm512_sub_ps(luminance(qr, qg, qb), l));
        const V dz = _mm512_abs_ps(_mm512_sub_ps(load(iz + o), z));
        V w = exp2(
            fma(by_normal, u, _mm512_fnmadd_ps(dl, by_luminance, _mm512_fnmadd_ps(dz, by_depth, all(t.log2_kernel)))));
        if constexpr (kChecked) w = _mm512_maskz_mov_ps(columns(x, sign * t.dx), w);
        sr = fma(w, qr, sr), sg = fma(w, qg, sg), sb = fma(w, qb, sb);
        sv = fma(_mm512_mul_ps(w, w), load(iv + o), sv);
        sw = _mm512_add_ps(sw, w);
      }
    }
    const V inverse = _mm512_div_ps(all(1), sw);
    const __mmask16 inside = columns(x, 0);
    _mm512_mask_storeu_ps(row.out[kR] + x, inside, _mm512_mul_ps(sr, inverse));
    _mm512_mask_storeu_ps(row.out[kG] + x, inside, _mm512_mul_ps(sg, inverse));
    _mm512_mask_storeu_ps(row.out[kB] + x, inside, _mm512_mul_ps(sb, inverse));
    _mm512_mask_storeu_ps(row.out[kVariance] + x, inside, _mm512_mul_ps(sv, _mm512_mul_ps(inverse, inverse)));
  }

  int width_, height_;
  LevelRule rule_;
};

#endif

}  // namespace quell::bench
