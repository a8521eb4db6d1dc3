// The joint bilateral filter of GAMES202 homework 5 as one writes it down: plain loops over pixels that hold their
// values together, std::acos, std::sqrt and std::exp at each tap.
#pragma once

#include "core/image/image.h"
#include "tests/bench/naive_picture.h"
#include "tests/bench/window_rule.h"

#include <algorithm>
#include <cmath>

namespace quell::bench {

class NaiveWindow {
 public:
  NaiveWindow(const quell_image& color, const quell_image& normal, const quell_image& position, WindowRule rule)
      : width_(color.width),
        height_(color.height),
        rule_(rule),
        color_(colors(color)),
        normal_(colors(normal)),
        position_(colors(position)),
        out_(width_, height_) {}

  float at(int channel, int x, int y) const {
    const Rgb c = out_(x, y);
    return channel == 0 ? c.r : channel == 1 ? c.g : c.b;
  }

  void band(int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < width_; ++x) out_(x, y) = mean(x, y);
  }

 private:
  static float over(float squared, float sigma) { return squared / (2 * sigma * sigma); }

  Rgb mean(int x, int y) const {
    const Rgb c = color_(x, y), n = normal_(x, y), p = position_(x, y);
    Rgb sum = c;
    float weights = 1;
    for (int dy = -rule_.radius; dy <= rule_.radius; ++dy)
      for (int dx = -rule_.radius; dx <= rule_.radius; ++dx) {
        const int u = x + dx, v = y + dy;
        if (!color_.contains(u, v) || (dx == 0 && dy == 0)) continue;
        const Rgb m = normal_(u, v), difference = color_(u, v) - c, apart = position_(u, v) - p;
        if (is_zero(n) != is_zero(m)) continue;
        float exponent =
            over(float(dx * dx + dy * dy), rule_.sigma_distance) + over(dot(difference, difference), rule_.sigma_color);
        if (!is_zero(n)) {
          const float angle = std::acos(std::clamp(dot(n, m), 0.0f, 1.0f)), distance = std::sqrt(dot(apart, apart));
          const float sine = distance > 0 ? dot(n, apart) / distance : 0;
          exponent += over(angle * angle, rule_.sigma_normal) + over(sine * sine, rule_.sigma_plane);
        }
        const float w = std::exp(-exponent);
        sum = sum + w * color_(u, v), weights += w;
      }
    return (1 / weights) * sum;
  }

  int width_, height_;
  WindowRule rule_;
  Picture<Rgb> color_, normal_, position_, out_;
};

}  // namespace quell::bench
