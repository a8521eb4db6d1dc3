// SVGF as one writes it down from the paper: plain loops over pixels that hold their colour together, std::pow and
// std::exp at each tap, all images new in each frame. The same algorithm as graphs/svgf.json at its defaults, stage by
// stage and in its order; the difference between the two is one of speed.
#pragma once

#include "tests/bench/naive_picture.h"
#include "tests/bench/turns.h"

#include <quell/types.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace quell::bench {

struct NaiveFrame {
  Picture<Rgb> color, albedo, normal, emission;
  Picture<float> depth;
  Picture<Pair> motion;
  Picture<std::uint32_t> id;
};

class NaiveSvgf {
 public:
  NaiveSvgf(int width, int height, int threads) : width_(width), height_(height), threads_(threads) {}

  // The frame's result. `keep`: on to the next frame; else the same frame may come again.
  Picture<Rgb> filter(const NaiveFrame& in, bool keep) {
    const Split s = split(in);
    const auto light = each<Rgb>([&](int x, int y) { return s.lit(x, y) / clipped(in.albedo(x, y)); });
    const auto slope = each<Pair>([&](int x, int y) { return slope_at(s.depth, x, y); });
    const auto taps = each<Taps>([&](int x, int y) { return taps_at(in, s, slope, x, y); });
    const auto age = each<float>([&](int x, int y) {
      return std::clamp(1 + (before_.age.empty() ? 0 : history(before_.age, taps(x, y), 0.0f)), 1.0f, 32.0f);
    });
    const auto blend = each<Rgb>([&](int x, int y) {
      const float a = share(0.1f, age(x, y));
      if (a == 1) return light(x, y);
      const Rgb then = history(before_.image, taps(x, y), Rgb{});
      return then + a * (light(x, y) - then);
    });
    const auto moments = each<Rgb>([&](int x, int y) {
      const float l = luminance(light(x, y)), a = share(0.2f, age(x, y));
      const Rgb now{l, l * l, 0};
      if (a == 1) return now;
      const Rgb then = history(before_.moments, taps(x, y), Rgb{});
      return then + a * (now - then);
    });
    Signal signal{Picture<Rgb>(width_, height_), Picture<float>(width_, height_)};
    rows([&](int x, int y) { estimate(s, slope, blend, moments, age, signal, x, y); });
    Picture<Rgb> first;
    for (int step = 1; step <= 16; step *= 2) {
      signal = level(s, slope, signal, step);
      if (step == 1) first = signal.image;
    }
    auto out = each<Rgb>([&](int x, int y) { return signal.image(x, y) * clipped(in.albedo(x, y)) + s.aside(x, y); });
    if (keep) before_ = {s.depth, s.normal, in.id, age, first, moments};
    return out;
  }

 private:
  struct Split {
    Picture<Rgb> lit, aside, normal;
    Picture<float> depth;
  };
  struct Taps {
    int x = 0, y = 0;                  // north-west of four
    float weight[4] = {};              // all 0: none of them is valid
    int nearest_x = 0, nearest_y = 0;  // whose neighbours stand in then
    bool around[9] = {};               // the valid ones of them
  };
  struct Signal {
    Picture<Rgb> image;
    Picture<float> variance;
  };
  struct Before {
    Picture<float> depth;
    Picture<Rgb> normal;
    Picture<std::uint32_t> id;
    Picture<float> age;
    Picture<Rgb> image, moments;
  };

  template <class Visit>
  void rows(Visit visit) const {
    in_bands(threads_, height_, [&](int y0, int y1) {
      for (int y = y0; y < y1; ++y)
        for (int x = 0; x < width_; ++x) visit(x, y);
    });
  }
  template <class T, class Make>
  Picture<T> each(Make make) const {
    Picture<T> out(width_, height_);
    rows([&](int x, int y) { out(x, y) = make(x, y); });
    return out;
  }

  static bool miss(float depth) { return depth >= 0.5f * kFar; }
  static Rgb clipped(Rgb a) {
    return {std::clamp(a.r, 0.1f, 1.0f), std::clamp(a.g, 0.1f, 1.0f), std::clamp(a.b, 0.1f, 1.0f)};
  }
  static float share(float alpha, float count) { return count > 1 ? std::max(alpha, 1 / count) : 1; }

  Split split(const NaiveFrame& in) const {
    Split s{Picture<Rgb>(width_, height_), Picture<Rgb>(width_, height_), Picture<Rgb>(width_, height_),
            Picture<float>(width_, height_)};
    rows([&](int x, int y) {
      const Rgb color = in.color(x, y), emission = in.emission(x, y), rest = color - emission;
      const bool aside =
          is_zero(in.normal(x, y)) || miss(in.depth(x, y)) || emission.r > 0 || emission.g > 0 || emission.b > 0;
      s.lit(x, y) = aside ? Rgb{} : Rgb{std::max(rest.r, 0.0f), std::max(rest.g, 0.0f), std::max(rest.b, 0.0f)};
      s.aside(x, y) = color - s.lit(x, y);
      s.normal(x, y) = aside ? Rgb{} : in.normal(x, y);
      s.depth(x, y) = aside ? kFar : in.depth(x, y);
    });
    return s;
  }

  static float slope_of(float before, float here, float after) {
    const float left = here - before, right = after - here;
    if (miss(here)) return 0;
    if (miss(before)) return miss(after) ? 0 : right;
    if (miss(after)) return left;
    if (std::abs(right - left) <= 0.25f * (std::abs(left) + std::abs(right))) return 0.5f * (left + right);
    return std::abs(left) <= std::abs(right) ? left : right;
  }
  Pair slope_at(const Picture<float>& depth, int x, int y) const {
    const auto at = [&](int u, int v) { return depth.contains(u, v) ? depth(u, v) : kFar; };
    return {slope_of(at(x - 1, y), at(x, y), at(x + 1, y)), slope_of(at(x, y - 1), at(x, y), at(x, y + 1))};
  }

  bool same_surface(const NaiveFrame& in, const Split& s, Pair slope, int x, int y, int u, int v) const {
    if (!before_.id.contains(u, v) || in.id(x, y) != before_.id(u, v)) return false;
    const float z = s.depth(x, y), then = before_.depth(u, v);
    if (miss(z) != miss(then)) return false;
    if (!miss(z) && std::abs(z - then) > 10 * (std::abs(slope.x) + std::abs(slope.y) + 0.01f * z)) return false;
    const Rgb n = s.normal(x, y), before = before_.normal(u, v);
    if (is_zero(n) != is_zero(before)) return false;
    return is_zero(n) || dot(n, before) >= 0.9f;
  }
  Taps taps_at(const NaiveFrame& in, const Split& s, const Picture<Pair>& slope, int x, int y) const {
    Taps t;
    const float px = float(x) + in.motion(x, y).x, py = float(y) + in.motion(x, y).y;
    const bool inside = px >= -0.5f && py >= -0.5f && px < float(width_) - 0.5f && py < float(height_) - 0.5f;
    if (before_.id.empty() || !inside) return t;
    t.x = int(std::floor(px)), t.y = int(std::floor(py));
    const float fx = px - float(t.x), fy = py - float(t.y);
    t.nearest_x = t.x + (fx >= 0.5f), t.nearest_y = t.y + (fy >= 0.5f);
    float sum = 0;
    for (int k = 0; k < 4; ++k) {
      const int dx = k % 2, dy = k / 2;
      if (!same_surface(in, s, slope(x, y), x, y, t.x + dx, t.y + dy)) continue;
      t.weight[k] = (dx ? fx : 1 - fx) * (dy ? fy : 1 - fy);
      sum += t.weight[k];
    }
    for (float& w : t.weight) w = sum >= 0.01f ? w / sum : 0;
    for (int k = 0; k < 9; ++k)
      t.around[k] = same_surface(in, s, slope(x, y), x, y, t.nearest_x + k % 3 - 1, t.nearest_y + k / 3 - 1);
    return t;
  }
  template <class T>
  static T history(const Picture<T>& image, const Taps& t, T none) {
    T sum = none;
    float weights = 0;
    for (int k = 0; k < 4; ++k)
      if (t.weight[k] > 0) sum = sum + t.weight[k] * image(t.x + k % 2, t.y + k / 2), weights += t.weight[k];
    if (weights > 0) return sum;
    for (int k = 0; k < 9; ++k)
      if (t.around[k]) sum = sum + image(t.nearest_x + k % 3 - 1, t.nearest_y + k / 3 - 1), weights += 1;
    return weights > 0 ? (1 / weights) * sum : none;
  }

  static float by_normal(Rgb n, Rgb m) {
    if (is_zero(n) || is_zero(m)) return is_zero(n) && is_zero(m) ? 1 : 0;
    return std::pow(std::max(0.0f, dot(n, m)), 128.0f);
  }
  static float by_depth(float z, float then, Pair slope, int dx, int dy, float sigma) {
    return std::exp(-std::abs(z - then) / (sigma * std::abs(slope.x * float(dx) + slope.y * float(dy)) + 1e-4f));
  }

  void estimate(const Split& s, const Picture<Pair>& slope, const Picture<Rgb>& image, const Picture<Rgb>& moments,
                const Picture<float>& age, Signal& out, int x, int y) const {
    Rgb mean = image(x, y), m = moments(x, y);
    float boost = 1;
    if (age(x, y) < 3) {
      float weights = 1;
      for (int dy = -3; dy <= 3; ++dy)
        for (int dx = -3; dx <= 3; ++dx) {
          const int u = x + dx, v = y + dy;
          if (!image.contains(u, v) || (dx == 0 && dy == 0)) continue;
          const float w = by_normal(s.normal(x, y), s.normal(u, v)) *
                          by_depth(s.depth(x, y), s.depth(u, v), slope(x, y), dx, dy, 3) *
                          std::exp(-std::abs(luminance(image(x, y)) - luminance(image(u, v))) / 10);
          mean = mean + w * image(u, v), m = m + w * moments(u, v), weights += w;
        }
      mean = (1 / weights) * mean, m = (1 / weights) * m;
      boost = 4 / std::max(age(x, y), 1.0f);
    }
    out.image(x, y) = mean;
    out.variance(x, y) = boost * std::max(0.0f, m.g - m.r * m.r);
  }

  Signal level(const Split& s, const Picture<Pair>& slope, const Signal& in, int step) const {
    static constexpr float kernel[] = {1 / 16.f, 4 / 16.f, 6 / 16.f, 4 / 16.f, 1 / 16.f}, small[] = {1, 2, 1};
    Signal out{Picture<Rgb>(width_, height_), Picture<float>(width_, height_)};
    rows([&](int x, int y) {
      float noise = 0, all = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          if (in.variance.contains(x + dx, y + dy)) {
            const float k = small[dx + 1] * small[dy + 1];
            noise += k * in.variance(x + dx, y + dy), all += k;
          }
      const float deviation = 4 * std::sqrt(std::max(0.0f, noise / all)) + 1e-4f, l = luminance(in.image(x, y));
      Rgb sum;
      float variance = 0, weights = 0;
      for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
          const int dx = i * step, dy = j * step, u = x + dx, v = y + dy;
          if (!in.image.contains(u, v)) continue;
          float w = kernel[i + 2] * kernel[j + 2];
          if (i || j)
            w *= by_normal(s.normal(x, y), s.normal(u, v)) *
                 by_depth(s.depth(x, y), s.depth(u, v), slope(x, y), dx, dy, 1) *
                 std::exp(-std::abs(l - luminance(in.image(u, v))) / deviation);
          sum = sum + w * in.image(u, v), variance += w * w * in.variance(u, v), weights += w;
        }
      out.image(x, y) = (1 / weights) * sum;
      out.variance(x, y) = variance / (weights * weights);
    });
    return out;
  }

  int width_, height_, threads_;
  Before before_;
};

}  // namespace quell::bench
