// Ranges are held to what floats can be, so that neither their differences nor their factors overflow.
#include "core/lab/range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace quell {

std::string problem_of_range(double from, double to, bool log) {
  constexpr double kLargest = std::numeric_limits<float>::max(), kSmallest = std::numeric_limits<float>::min();
  const double least = std::min(from, to), most = std::max(std::abs(from), std::abs(to));
  if (most > kLargest) return fmt::format("a range lies within ±{:.3g}, not at {}", kLargest, most);
  if (log && least <= 0) return fmt::format("a range on a log scale lies above 0, not at {}", least);
  if (log && least < kSmallest)
    return fmt::format("a range on a log scale lies above {:.3g}, not at {}", kSmallest, least);
  return "";
}

double in_range(double from, double to, bool log, double share) {
  return log ? from * std::pow(to / from, share) : from + (to - from) * share;
}

double six_digits(double x) { return std::strtod(fmt::format("{:.6g}", x).c_str(), nullptr); }

}  // namespace quell
