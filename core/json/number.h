// Floats as JSON numbers.
#pragma once

#include <fmt/format.h>

#include <cstdlib>

namespace quell {

// The number that is written shortest and is this float again: 0.1, not 0.10000000149.
inline double shortest_number(float value) {
  const double shortest = std::strtod(fmt::format("{}", value).c_str(), nullptr);
  return float(shortest) == value ? shortest : double(value);
}

}  // namespace quell
