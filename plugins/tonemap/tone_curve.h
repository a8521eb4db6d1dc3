// The operators of tonemap as numbers: what the kernel and its test share is the definition, not the arithmetic.
#pragma once

#include <cstdint>

namespace quell::tone {

enum class Operator : std::int32_t { clamp, reinhard, aces, hable };
enum class Encoding : std::int32_t { srgb, linear };

// (square·x² + linear·x) / (over_square·x² + over_linear·x + over_one)
struct Rational {
  float square, linear, over_square, over_linear, over_one;
};

// Narkowicz's fit of the ACES view of sRGB displays, with his pre-exposure of 0.6 multiplied in.
inline constexpr Rational kAces{0.36f * 2.51f, 0.6f * 0.03f, 0.36f * 2.43f, 0.6f * 0.59f, 0.14f};

// Hable's filmic curve, scaled so that his white point 11.2 becomes 1.
inline constexpr Rational hable() {
  constexpr double a = 0.15, b = 0.50, c = 0.10, d = 0.20, e = 0.02, f = 0.30, white = 11.2;
  // (x(ax + cb) + de) / (x(ax + b) + df) − e/f over one denominator
  constexpr double square = a * f - a * e, linear = c * b * f - b * e;
  constexpr double over_square = a * f, over_linear = b * f, over_one = d * f * f;
  constexpr double scale =
      (over_square * white * white + over_linear * white + over_one) / (square * white * white + linear * white);
  return {float(scale * square), float(scale * linear), float(over_square), float(over_linear), float(over_one)};
}

}  // namespace quell::tone
