// What weights as nodes cost: an à-trous level of SVGF as four plugins against the same level fused by hand.
//
// Both filter 1080p on one thread with denormals flushed, interleaved band by band in one process; the minimum of each
// band over the rounds counts, in thread CPU time, so that other work on the machine disturbs little. The opponent is
// written for AVX-512, has no border code (its planes have a border of zero normals), takes the cosine's power by
// squaring and knows its inputs when it is compiled.
#include "tests/support/run_node.h"

#include <immintrin.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#ifdef __AVX512F__
namespace {

using quell::Image;
using quell::test::Node;

constexpr int kWidth = 1920, kHeight = 1080, kBand = 270;
constexpr float kLog2E = 1.44269504f, kSigmaLuminance = 4, kSigmaDepth = 1, kEpsilon = 1e-4f;

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

struct Scene {
  Image color{kWidth, kHeight, 3}, variance{kWidth, kHeight, 1}, normal{kWidth, kHeight, 3}, depth{kWidth, kHeight, 1},
      slope{kWidth, kHeight, 2};

  Scene()
      : color(quell::test::noise_image(kWidth, kHeight, 3, 1)),
        variance(quell::test::noise_image(kWidth, kHeight, 1, 2, 0.01f, 0.06f)) {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const float u = float(x) / 240, v = float(y) / 180;
        const float a = std::sin(std::floor(u) * 1.7f) * 0.5f + 0.1f * std::sin(u * 3),
                    b = std::cos(std::floor(v) * 2.3f) * 0.5f;
        const float length = std::sqrt(a * a + b * b + 1);
        normal.at(0, x, y) = a / length, normal.at(1, x, y) = b / length, normal.at(2, x, y) = 1 / length;
        depth.at(0, x, y) = 5 + u * 0.3f + v * 0.2f + std::floor(u);
        slope.at(0, x, y) = 0.3f / 240, slope.at(1, x, y) = 0.2f / 180;
      }
  }
};

// Planes with a border that a tap may fall into, for the fused level.
class Padded {
 public:
  static constexpr int kBorder = 64, kPitch = kWidth + 2 * kBorder + 16;  // rows no multiple of 4096 bytes apart
  void add(const Image& image) {
    for (int c = 0; c < image.channels(); ++c) {
      planes_.emplace_back(std::size_t(kPitch) * (kHeight + 2 * kBorder) + 64, 0.0f);
      for (int y = 0; y < kHeight; ++y) std::copy_n(image.row(c, y), kWidth, planes_.back().data() + at(0, y));
    }
  }
  static std::size_t at(int x, int y) { return std::size_t(y + kBorder) * kPitch + std::size_t(x + kBorder); }
  float* plane(int i) { return planes_[std::size_t(i)].data(); }
  const float* plane(int i) const { return planes_[std::size_t(i)].data(); }

 private:
  std::vector<std::vector<float>> planes_;
};

__m512 all(float f) { return _mm512_set1_ps(f); }
__m512 load(const float* p) { return _mm512_loadu_ps(p); }
__m512 fma(__m512 a, __m512 b, __m512 c) { return _mm512_fmadd_ps(a, b, c); }
__m512 luminance(__m512 r, __m512 g, __m512 b) {
  return fma(r, all(.2126f), fma(g, all(.7152f), _mm512_mul_ps(b, all(.0722f))));
}
__m512 exp2(__m512 x) {
  const __m512 n = _mm512_roundscale_ps(x, 0), f = _mm512_sub_ps(x, n);
  __m512 p = fma(f, all(0.0096181f), all(0.0555041f));
  p = fma(p, f, all(0.2402265f));
  p = fma(p, f, all(0.6931472f));
  return _mm512_scalef_ps(fma(p, f, all(1)), n);
}

class Fused {
 public:
  explicit Fused(const Scene& s) {
    for (const Image* image : {&s.color, &s.variance, &s.normal, &s.depth, &s.slope}) in_.add(*image);
    for (const Image* image : {&s.color, &s.variance}) out_.add(*image);
  }
  void band(int step, int y0, int y1) {
    constexpr float kernel[] = {6 / 16.f, 4 / 16.f, 1 / 16.f};
    std::vector<Tap> taps;
    for (int dy = 0; dy <= 2; ++dy)
      for (int dx = dy ? -2 : 1; dx <= 2; ++dx)
        taps.push_back({(dy * Padded::kPitch + dx) * step, float(dx * step), float(dy * step),
                        std::log2(kernel[std::abs(dx)] * kernel[dy])});
    for (int residue = 0; residue < step; ++residue)
      for (int y = y0 + residue; y < y1; y += step) row(taps, y);
  }
  float at(int channel, int x, int y) const { return out_.plane(channel)[Padded::at(x, y)]; }

 private:
  struct Tap {
    std::ptrdiff_t offset;
    float dx, dy, log2_kernel;
  };
  enum { kR, kG, kB, kVariance, kNx, kNy, kNz, kDepth, kSlopeX, kSlopeY };

  void row(const std::vector<Tap>& taps, int y) {
    const float* p[10];
    for (int i = 0; i < 10; ++i) p[i] = in_.plane(i) + Padded::at(0, y);
    for (int x = 0; x < kWidth; x += 16) {
      const __m512 r = load(p[kR] + x), g = load(p[kG] + x), b = load(p[kB] + x), v = load(p[kVariance] + x);
      const __m512 nx = load(p[kNx] + x), ny = load(p[kNy] + x), nz = load(p[kNz] + x), z = load(p[kDepth] + x);
      const __m512 sx = load(p[kSlopeX] + x), sy = load(p[kSlopeY] + x), l = luminance(r, g, b);
      const __m512 by_luminance = _mm512_div_ps(
          all(kLog2E), fma(all(kSigmaLuminance), _mm512_sqrt_ps(_mm512_max_ps(v, all(0))), all(kEpsilon)));
      constexpr float centre = 36 / 256.f;
      __m512 sr = _mm512_mul_ps(r, all(centre)), sg = _mm512_mul_ps(g, all(centre)), sb = _mm512_mul_ps(b, all(centre));
      __m512 sv = _mm512_mul_ps(v, all(centre * centre)), sw = all(centre);
      for (const Tap& t : taps) {
        const __m512 change = _mm512_abs_ps(fma(sx, all(t.dx), _mm512_mul_ps(sy, all(t.dy))));
        const __m512 by_depth =
            _mm512_mul_ps(all(kLog2E), _mm512_rcp14_ps(fma(all(kSigmaDepth), change, all(kEpsilon))));
        for (const std::ptrdiff_t o : {t.offset + x, -t.offset + x}) {
          const __m512 qr = load(p[kR] + o), qg = load(p[kG] + o), qb = load(p[kB] + o);
          __m512 d = _mm512_max_ps(
              all(0), fma(load(p[kNx] + o), nx, fma(load(p[kNy] + o), ny, _mm512_mul_ps(load(p[kNz] + o), nz))));
          for (int i = 0; i < 7; ++i) d = _mm512_mul_ps(d, d);  // power 128
          const __m512 dl = _mm512_abs_ps(_mm512_sub_ps(luminance(qr, qg, qb), l));
          const __m512 dz = _mm512_abs_ps(_mm512_sub_ps(load(p[kDepth] + o), z));
          const __m512 w = _mm512_mul_ps(
              d, exp2(_mm512_fnmadd_ps(dl, by_luminance, _mm512_fnmadd_ps(dz, by_depth, all(t.log2_kernel)))));
          sr = fma(w, qr, sr), sg = fma(w, qg, sg), sb = fma(w, qb, sb);
          sv = fma(_mm512_mul_ps(w, w), load(p[kVariance] + o), sv);
          sw = _mm512_add_ps(sw, w);
        }
      }
      const __m512 inverse = _mm512_div_ps(all(1), sw);
      float* const out = out_.plane(0) + Padded::at(x, y);
      _mm512_storeu_ps(out, _mm512_mul_ps(sr, inverse));
      _mm512_storeu_ps(out_.plane(1) + Padded::at(x, y), _mm512_mul_ps(sg, inverse));
      _mm512_storeu_ps(out_.plane(2) + Padded::at(x, y), _mm512_mul_ps(sb, inverse));
      _mm512_storeu_ps(out_.plane(3) + Padded::at(x, y), _mm512_mul_ps(sv, _mm512_mul_ps(inverse, inverse)));
    }
  }

  Padded in_, out_;
};

// The same level as a graph would run it: atrous with three weight nodes, each from its own library.
class Plugins {
 public:
  explicit Plugins(const Scene& s)
      : image_(s.color.view()),
        variance_(s.variance.view()),
        color_out_(kWidth, kHeight, 3),
        variance_out_(kWidth, kHeight, 1) {
    normal_.set("power", 128.0f).in("normal", s.normal);
    depth_.set("sigma", kSigmaDepth).set("epsilon", kEpsilon).in("depth", s.depth).in("slope", s.slope);
    luminance_.set("sigma", kSigmaLuminance).set("epsilon", kEpsilon).in("image", s.color).in("variance", s.variance);
    for (Node* node : {&normal_, &depth_, &luminance_}) weights_.push_back(node->bound());
    out_[0] = color_out_.view(), out_[1] = variance_out_.view();
    inputs_[0] = {&image_, nullptr, 1}, inputs_[1] = {&variance_, nullptr, 1};
    inputs_[2] = {nullptr, weights_.data(), int(weights_.size())};
  }
  void band(int step, int y0, int y1) {
    const auto* type = quell::test::registry().find("atrous");
    quell::Instance instance(*type);
    instance.set_int(type->find_param("step"), step);
    const quell_tile tile{inputs_, out_, 0, y0, kWidth, y1, 0};
    quell_error error;
    if (type->table().run(instance.data(), nullptr, &tile, &error)) std::fprintf(stderr, "%s\n", error.text);
  }
  float at(int channel, int x, int y) const {
    return channel < 3 ? color_out_.at(channel, x, y) : variance_out_.at(0, x, y);
  }

 private:
  Node normal_{"normal_weight"}, depth_{"depth_weight"}, luminance_{"luminance_weight"};
  std::vector<quell_bound_weight> weights_;
  quell_image image_, variance_, out_[2];
  quell_input inputs_[3];
  Image color_out_, variance_out_;
};

}  // namespace

int main(int argc, char** argv) {
  if (!__builtin_cpu_supports("avx512f")) return std::puts("needs a machine with AVX-512"), 1;
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 7;
  _mm_setcsr(_mm_getcsr() | 0x8040);  // flush to zero, denormals are zero, as on the host's threads
  static const Scene scene;
  static Fused fused(scene);
  static Plugins plugins(scene);
  double sum_fused = 0, sum_plugins = 0;
  for (const int step : {1, 2, 4, 8, 16}) {
    double by_fused = 0, by_plugins = 0;
    for (int y = 0; y < kHeight; y += kBand) {
      double best_fused = 1e9, best_plugins = 1e9;
      for (int i = 0; i < rounds; ++i) {
        const double a = cpu_seconds();
        fused.band(step, y, y + kBand);
        const double b = cpu_seconds();
        plugins.band(step, y, y + kBand);
        best_fused = std::min(best_fused, b - a), best_plugins = std::min(best_plugins, cpu_seconds() - b);
      }
      by_fused += best_fused, by_plugins += best_plugins;
    }
    double difference = 0;
    for (int c = 0; c < 4; ++c)
      for (int y = 64; y < kHeight - 64; ++y)
        for (int x = 64; x < kWidth - 64; ++x)
          difference = std::max(difference, double(std::abs(fused.at(c, x, y) - plugins.at(c, x, y))));
    std::printf("step %2d: fused %6.1f ms, plugins %6.1f ms, ratio %.3f; largest difference %.1e\n", step,
                by_fused * 1e3, by_plugins * 1e3, by_plugins / by_fused, difference);
    sum_fused += by_fused, sum_plugins += by_plugins;
  }
  std::printf("five levels: fused %6.1f ms, plugins %6.1f ms, ratio %.3f\n", sum_fused * 1e3, sum_plugins * 1e3,
              sum_plugins / sum_fused);
}
#else
int main() { return std::puts("built without AVX-512: nothing to compare with"), 1; }
#endif
