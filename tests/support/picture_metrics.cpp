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

double brightness_error(const Image& x, Reference r) {
  double sum = 0, reference = 0;
  for (int c = 0; c < 3; ++c)
    for (int v = 0; v < x.height(); ++v)
      for (int u = 0; u < x.width(); ++u)
        sum += x.at(c, u, v), reference += 0.5 * (double(r.a.at(c, u, v)) + double(r.b.at(c, u, v)));
  return sum / reference - 1;
}

double flicker(const Image& x, const Image& before, const Image& motion, const Image& id, const Image& id_before) {
  double sum = 0;
  long count = 0;
  for (int v = 0; v < x.height(); ++v)
    for (int u = 0; u < x.width(); ++u) {
      const double su = u + double(motion.at(0, u, v)), sv = v + double(motion.at(1, u, v));
      const int pu = int(std::floor(su)), pv = int(std::floor(sv));
      if (pu < 0 || pv < 0 || pu + 1 >= x.width() || pv + 1 >= x.height()) continue;
      const double fu = su - pu, fv = sv - pv, w[4] = {(1 - fu) * (1 - fv), fu * (1 - fv), (1 - fu) * fv, fu * fv};
      bool same = true;
      for (int k = 0; k < 4; ++k) same = same && id_before.bits(0, pv + k / 2)[pu + k % 2] == id.bits(0, v)[u];
      if (!same) continue;
      for (int c = 0; c < 3; ++c) {
        double warped = 0;
        for (int k = 0; k < 4; ++k) warped += w[k] * tone(before.at(c, pu + k % 2, pv + k / 2));
        sum += std::abs(tone(x.at(c, u, v)) - warped);
      }
      count += 3;
    }
  return 1000 * sum / double(std::max(count, 1L));
}

}  // namespace quell::test
