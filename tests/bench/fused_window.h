// The joint bilateral filter of GAMES202 homework 5 over a whole square window, fused by hand for AVX-512: nine planes,
// all weights of a tap in one exponent, one exp2, mirrored taps together, borders of zero normals.
#pragma once

#include "tests/bench/avx512.h"
#include "tests/bench/padded.h"
#include "tests/bench/window_rule.h"

#include <vector>

namespace quell::bench {

#ifdef __AVX512F__

class FusedWindow {
 public:
  FusedWindow(int width, int height, WindowRule rule)
      : width_(width), height_(height), rule_(rule), in_(width, height, 9), out_(width, height, 3) {
    for (int dy = 0; dy <= rule.radius; ++dy)
      for (int dx = dy ? -rule.radius : 1; dx <= rule.radius; ++dx)
        taps_.push_back({dy * in_.pitch() + dx,
                         -float(dx * dx + dy * dy) * kLog2E / (2 * rule.sigma_distance * rule.sigma_distance)});
  }
  void take(const quell_image& color, const quell_image& normal, const quell_image& position) {
    in_.take(0, color), in_.take(3, normal), in_.take(6, position);
  }
  const Padded& out() const { return out_; }

  void band(int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < width_; x += 16) pixels(x, y);
  }

 private:
  struct Tap {
    std::ptrdiff_t offset;
    float log2_kernel;
  };

  void pixels(int x, int y) {
    const float* p[9];
    for (int i = 0; i < 9; ++i) p[i] = in_.row(i, y) + x;
    const V r = load(p[0]), g = load(p[1]), b = load(p[2]), nx = load(p[3]), ny = load(p[4]), nz = load(p[5]);
    const V px = load(p[6]), py = load(p[7]), pz = load(p[8]);
    const auto falloff = [](float sigma) { return all(-kLog2E / (2 * sigma * sigma)); };
    const V by_color = falloff(rule_.sigma_color), by_angle = falloff(rule_.sigma_normal),
            by_plane = falloff(rule_.sigma_plane);
    V sr = r, sg = g, sb = b, sw = all(1);
    for (const Tap& t : taps_) {
#pragma GCC unroll 2
      for (const std::ptrdiff_t o : {t.offset, -t.offset}) {
        const V qr = load(p[0] + o), qg = load(p[1] + o), qb = load(p[2] + o);
        const V dr = _mm512_sub_ps(qr, r), dg = _mm512_sub_ps(qg, g), db = _mm512_sub_ps(qb, b);
        const V color = fma(dr, dr, fma(dg, dg, _mm512_mul_ps(db, db)));
        // acos²(1 - u) as a polynomial, without root and arc-cosine.
        const V u = _mm512_max_ps(
            all(0),
            _mm512_fnmadd_ps(load(p[3] + o), nx,
                             _mm512_fnmadd_ps(load(p[4] + o), ny, _mm512_fnmadd_ps(load(p[5] + o), nz, all(1)))));
        V angle = fma(u, all(0.009217675825f), all(-0.01059838758f));
        angle = fma(angle, u, all(0.02171450236f));
        angle = fma(angle, u, all(0.02409457386f));
        angle = fma(angle, u, all(0.08969117939f));
        angle = fma(angle, u, all(0.3332802896f));
        angle = _mm512_mul_ps(fma(angle, u, all(2.000000567f)), u);
        const V dx = _mm512_sub_ps(load(p[6] + o), px), dy = _mm512_sub_ps(load(p[7] + o), py),
                dz = _mm512_sub_ps(load(p[8] + o), pz);
        const V away = fma(nx, dx, fma(ny, dy, _mm512_mul_ps(nz, dz)));
        const V apart = fma(dx, dx, fma(dy, dy, _mm512_mul_ps(dz, dz)));
        const V plane = _mm512_mul_ps(_mm512_mul_ps(away, away), _mm512_rcp14_ps(_mm512_max_ps(apart, all(1e-30f))));
        const V w = exp2(fma(color, by_color, fma(angle, by_angle, fma(plane, by_plane, all(t.log2_kernel)))));
        sr = fma(w, qr, sr), sg = fma(w, qg, sg), sb = fma(w, qb, sb);
        sw = _mm512_add_ps(sw, w);
      }
    }
    const V inverse = _mm512_div_ps(all(1), sw);
    _mm512_storeu_ps(out_.row(0, y) + x, _mm512_mul_ps(sr, inverse));
    _mm512_storeu_ps(out_.row(1, y) + x, _mm512_mul_ps(sg, inverse));
    _mm512_storeu_ps(out_.row(2, y) + x, _mm512_mul_ps(sb, inverse));
  }

  int width_, height_;
  WindowRule rule_;
  Padded in_, out_;
  std::vector<Tap> taps_;
};

#endif

}  // namespace quell::bench
