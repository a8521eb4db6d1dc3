// Means, percentiles and confidence intervals.
#include "core/lab/summary.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace quell {

namespace {

double percentile(const std::vector<double>& sorted, double share) {
  const double at = share * double(sorted.size() - 1);
  const auto below = std::size_t(at);
  const auto above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (sorted[above] - sorted[below]) * (at - double(below));
}

// P(0 < T < t). With T = sqrt(n) tan(a) the density becomes a power of the cosine, which Simpson's rule takes easily.
double probability(double t, double n) {
  const double last = std::atan(t / std::sqrt(n));
  const double scale = std::exp(std::lgamma((n + 1) / 2) - std::lgamma(n / 2)) / std::sqrt(std::numbers::pi);
  constexpr int kSteps = 512;
  double sum = 0;
  for (int i = 0; i <= kSteps; ++i)
    sum += std::pow(std::cos(last * i / kSteps), n - 1) * (i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2);
  return scale * sum * last / kSteps / 3;
}

}  // namespace

double student_t_95(std::size_t freedom) {
  double low = 1.9, high = 13;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (probability(middle, double(freedom)) < 0.475 ? low : high) = middle;
  }
  return (low + high) / 2;
}

Summary summarize(std::span<const double> numbers) {
  Summary s;
  s.count = numbers.size();
  if (numbers.empty()) return s;
  std::vector<double> sorted(numbers.begin(), numbers.end());
  std::ranges::sort(sorted);
  s.minimum = sorted.front(), s.maximum = sorted.back();
  s.median = percentile(sorted, 0.5), s.p95 = percentile(sorted, 0.95);
  double sum = 0, squares = 0;
  for (const double x : numbers) sum += x;
  s.mean = sum / double(s.count);
  for (const double x : numbers) squares += (x - s.mean) * (x - s.mean);
  const double n = double(s.count);
  const double half = s.count > 1 ? student_t_95(s.count - 1) * std::sqrt(squares / (n - 1) / n) : 0;
  s.low = s.mean - half, s.high = s.mean + half;
  return s;
}

}  // namespace quell
