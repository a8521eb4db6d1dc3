// Errors of pictures against noisy references.
#include "tests/support/picture_metrics.h"

#include <algorithm>
#include <cmath>

namespace quell::test {

namespace {

double tone(float x) { return double(x) / (1.0 + double(x)); }

}  // namespace

double psnr(const Image& x, Reference r) {
  double sum = 0;
  for (int c = 0; c < 3; ++c)
    for (int v = 0; v < x.height(); ++v)
      for (int u = 0; u < x.width(); ++u)
        sum += (tone(x.at(c, u, v)) - tone(r.a.at(c, u, v))) * (tone(x.at(c, u, v)) - tone(r.b.at(c, u, v)));
  return -10 * std::log10(std::max(sum, 1e-12) / (3.0 * x.width() * x.height()));
}

double relative_error(const Image& x, Reference r) {
  double sum = 0;
  for (int c = 0; c < 3; ++c)
    for (int v = 0; v < x.height(); ++v)
      for (int u = 0; u < x.width(); ++u) {
        const double value = x.at(c, u, v), a = r.a.at(c, u, v), b = r.b.at(c, u, v);
        sum += (value - a) * (value - b) / (0.25 * (a + b) * (a + b) + 0.01);
      }
  return sum / (3.0 * x.width() * x.height());
}

double flicker(const Image& x, const Image& before, const Image& motion, const Image& id, const Image& id_before) {
  double sum = 0;
  long count = 0;
  for (int v = 0; v < x.height(); ++v)
    for (int u = 0; u < x.width(); ++u) {
      const int pu = int(std::floor(float(u) + 0.5f + motion.at(0, u, v))),
                pv = int(std::floor(float(v) + 0.5f + motion.at(1, u, v)));
      if (pu < 0 || pv < 0 || pu >= x.width() || pv >= x.height()) continue;
      if (id_before.bits(0, pv)[pu] != id.bits(0, v)[u]) continue;
      for (int c = 0; c < 3; ++c) sum += std::abs(tone(x.at(c, u, v)) - tone(before.at(c, pu, pv)));
      count += 3;
    }
  return sum / double(std::max(count, 1L));
}

}  // namespace quell::test
