// FLIP's filters from their definitions, in double.
#include "flip/flip_filters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quell {

namespace {

constexpr double kPi = std::numbers::pi;
// Standard deviation of the feature detectors, degrees; half of an edge's width.
constexpr double kFeature = 0.5 * 0.082;
// Widest b of the contrast sensitivity functions a·√(π/b)·exp(−π² x² / b), x in degrees.
constexpr double kWidest = 0.04;

using Taps = std::vector<double>;

template <class F>
Taps taps(int radius, F f) {
  Taps t;
  for (int i = -radius; i <= radius; ++i) t.push_back(f(i));
  return t;
}
double sum(const Taps& t) {
  double s = 0;
  for (const double v : t) s += v;
  return s;
}
std::vector<float> scaled(Taps t, double factor) {
  for (double& v : t) v *= factor;
  return {t.begin(), t.end()};
}
// Positive weights to sum 1, negative ones to −1.
std::vector<float> balanced(const Taps& t) {
  double positive = 0, negative = 0;
  for (const double v : t) (v > 0 ? positive : negative) += std::abs(v);
  std::vector<float> out;
  for (const double v : t) out.push_back(float(v / (v > 0 ? positive : negative)));
  return out;
}

// Rec. 709 primaries and a D65 white, as FLIP rounds them.
constexpr double kXyz[9] = {10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794,
                            2613072.0 / 12288897,  8788810.0 / 12288897, 887015.0 / 12288897,
                            1425312.0 / 73733382,  8788810.0 / 73733382, 70074185.0 / 73733382};

void matrices(FlipFilters& f) {
  double m[9];
  for (int r = 0; r < 3; ++r) {
    const double white = kXyz[3 * r] + kXyz[3 * r + 1] + kXyz[3 * r + 2];
    for (int c = 0; c < 3; ++c) m[3 * r + c] = kXyz[3 * r + c] / white;
  }
  const auto minor = [&](int r, int c) {
    const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    return m[3 * r1 + c1] * m[3 * r2 + c2] - m[3 * r1 + c2] * m[3 * r2 + c1];
  };
  const double determinant = m[0] * minor(0, 0) + m[1] * minor(0, 1) + m[2] * minor(0, 2);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      f.to_xyz[3 * r + c] = float(m[3 * r + c]), f.to_rgb[3 * r + c] = float(minor(c, r) / determinant);
}

int feature_radius(double ppd) { return int(std::ceil(3 * kFeature * ppd)); }

}  // namespace

int flip_radius(double ppd) {
  const int sensitivity = int(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * ppd));
  return std::max(sensitivity, feature_radius(ppd));
}

FlipFilters flip_filters(double ppd) {
  FlipFilters f;
  const int r = f.radius = flip_radius(ppd);
  const auto sensitivity = [&](double b) {
    return taps(r, [&](int i) { return std::exp(-kPi * kPi * i * i / (ppd * ppd * b)); });
  };
  const auto normalised = [&](double b) {
    const auto t = sensitivity(b);
    return scaled(t, 1 / sum(t));
  };
  f.lightness = normalised(0.0047);
  f.red_green = normalised(0.0053);
  constexpr double kA[2] = {34.1, 13.5}, kB[2] = {0.04, 0.025};
  double share[2], all = 0;
  for (int i = 0; i < 2; ++i)
    share[i] = kA[i] * std::sqrt(kPi / kB[i]), all += share[i] * std::pow(sum(sensitivity(kB[i])), 2);
  for (int i = 0; i < 2; ++i) {
    f.blue_yellow[i] = scaled(sensitivity(kB[i]), 1);
    f.blue_yellow_column[i] = scaled(sensitivity(kB[i]), share[i] / all);
  }
  // Features have a radius of their own, beyond which their weights are 0.
  const double sigma = kFeature * ppd;
  const int near = feature_radius(ppd);
  const auto gauss = [&](int i) { return std::abs(i) > near ? 0.0 : std::exp(-i * i / (2 * sigma * sigma)); };
  const auto g = taps(r, gauss);
  f.gauss = scaled(g, 1 / sum(g));
  f.edge = balanced(taps(r, [&](int i) { return -i * gauss(i); }));
  f.point = balanced(taps(r, [&](int i) { return (i * i / (sigma * sigma) - 1) * gauss(i); }));
  matrices(f);
  return f;
}

}  // namespace quell
