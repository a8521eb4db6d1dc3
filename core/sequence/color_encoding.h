// What numbers of a file mean as light, by what the file states.
#pragma once

#include <string>

namespace quell {

// How linear light became the numbers of a file.
struct ColorEncoding {
  enum class Curve { linear, srgb, rec709, power, unknown };

  Curve curve = Curve::linear;
  double gamma = 1;  // of `power`: numbers to this power are light
  std::string name;  // of `unknown`, as the file states it

  bool operator==(const ColorEncoding&) const = default;
};

// `stated` is the name of a colour space as OpenImageIO gives it ("" where the file states none), `gamma` the one that
// the file states, or 0. Whole numbers without either are sRGB, as every tool that shows pictures takes them; floats
// are linear, unless they state a gamma.
ColorEncoding color_encoding(const std::string& stated, double gamma, bool whole_numbers);

// Of any curve but `unknown`.
float linear_light(const ColorEncoding&, float value);

}  // namespace quell
