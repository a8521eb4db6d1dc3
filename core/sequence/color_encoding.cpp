// The curves of IEC 61966-2-1 (sRGB) and ITU-R BT.709, and plain powers.
#include "core/sequence/color_encoding.h"

#include <algorithm>
#include <cmath>

namespace quell {

namespace {

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return text;
}

}  // namespace

ColorEncoding color_encoding(const std::string& stated, double gamma, bool whole_numbers) {
  using Curve = ColorEncoding::Curve;
  if (gamma > 0) {
    // What can state powers only has no other way to say sRGB: PNG's specification has writers of sRGB state 1/2.2, and
    // libpng takes a file that does for sRGB. Taken by the power, equal pixels of two tools would differ.
    if (std::abs(gamma - 2.2) < 0.005) return {Curve::srgb, 1, ""};
    if (gamma == 1) return {};
    return {Curve::power, gamma, ""};
  }
  if (!whole_numbers) return {};
  const std::string name = lower_case(stated);
  if (name.empty() || name == "srgb") return {Curve::srgb, 1, ""};
  if (name == "linear") return {};
  if (name == "rec709") return {Curve::rec709, 1, ""};
  return {Curve::unknown, 1, stated};
}

float linear_light(const ColorEncoding& encoding, float v) {
  switch (encoding.curve) {
    case ColorEncoding::Curve::srgb:
      return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
    case ColorEncoding::Curve::rec709:
      return v < 0.081f ? v / 4.5f : std::pow((v + 0.099f) / 1.099f, float(1 / 0.45));
    case ColorEncoding::Curve::power:
      return std::copysign(std::pow(std::abs(v), float(encoding.gamma)), v);
    default:
      return v;
  }
}

}  // namespace quell
