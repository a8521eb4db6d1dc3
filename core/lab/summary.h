// What many numbers of one kind come to.
#pragma once

#include <cstddef>
#include <span>

namespace quell {

struct Summary {
  std::size_t count = 0;
  double mean = 0, median = 0, p95 = 0, minimum = 0, maximum = 0;
  // 95 % confidence interval of the mean by Student's t, which takes the numbers as independent: neighbouring frames
  // are not quite. Of one number it is that number.
  double low = 0, high = 0;
};

// All 0 when there are none. Percentiles lie between the two nearest ranks, in proportion.
Summary summarize(std::span<const double> numbers);

// The t that |T| exceeds in 5 % of the cases, T of Student's distribution with `freedom` degrees of freedom, at
// least 1.
double student_t_95(std::size_t freedom);

}  // namespace quell
