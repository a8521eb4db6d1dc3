// How far each pixel lies from a reference, by one of the usual measures: the map of a metric.
#include <quell/node.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace {

enum class Measure : std::int32_t { squared, absolute, plain, relative, relative_mean, mrse, smape, mape };

struct Difference {
  quell::In<quell::Any> image, reference, reference_b;
  quell::In<quell::Scalar> mask;
  quell::Out<quell::Scalar> map;
  Measure measure = Measure::squared;
  float epsilon = 0.01f;

  void describe(quell::Describe& d) {
    d.summary("Measures how far each pixel of an image lies from a reference: the mean of its channels' errors.");
    d.source(
        "X the image, Y the reference, A and B two independent halves of one, whose noise cancels in (X − A)(X − B), "
        "so that its mean is that of (X − Y)² for a Y without noise. MRSE as pbrt 4 has it; relative errors as in "
        "Rousselle et al. 2011 and Bitterli et al. 2016; SMAPE as in Vogels et al. 2018.");
    d.in(image, "image", "X: what is judged.");
    d.in(reference, "reference", "Y, or A: of the image's type, size and channels.");
    d.in(reference_b, "reference_b", "B, for the measures that square: Y is the mean of A and B then.").optional();
    d.in(mask, "mask", "Pixels up to 0 have no error.").optional();
    d.out(map, "map", "Mean over channels of the measure; the largest float where that would overflow.");
    d.param(measure, "measure",
            "squared: (X − Y)², or (X − A)(X − B), which may be negative. absolute: |X − Y|. signed: X − Y. relative: "
            "squared / (Y² + epsilon). relative_mean: the same with Y's mean over channels below. mrse: squared / (|Y| "
            "+ epsilon)². smape: |X − Y| / (|X| + |Y| + epsilon). mape: |X − Y| / (|Y| + epsilon).",
            {"squared", "absolute", "signed", "relative", "relative_mean", "mrse", "smape", "mape"});
    d.param(
         epsilon, "epsilon",
         "Keeps relative measures finite in the dark, in units of their divisor. 0: where all are 0, so is the error.")
        .range(0, 1e6);
  }

  void shapes(const quell_spec& spec, quell_shape*) const {
    const int channels = spec.in[image.index].channels;
    const auto same = [&](int port, const char* name) {
      if (spec.in_count[port] && spec.in[port].channels != channels)
        throw std::runtime_error("image has " + std::to_string(channels) + " channels and " + name + " has " +
                                 std::to_string(spec.in[port].channels) + ": they must be of one kind");
    };
    same(reference.index, "reference");
    same(reference_b.index, "reference_b");
    if (spec.in_count[reference_b.index] && !squares())
      throw std::runtime_error(
          "reference_b goes with the measures that square (squared, relative, relative_mean, mrse): for others take "
          "the mean of both halves as reference");
  }

  void run(const quell::Tile& tile) const {
    const quell_image &x = tile[image], &a = tile[reference], &b = tile.has(reference_b) ? tile[reference_b] : a;
    constexpr double most = std::numeric_limits<float>::max();
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float* const marked = tile.has(mask) ? tile.row(mask, 0, y) : nullptr;
      float* const out = tile.row(map, 0, y);
      for (int u = tile.x0; u < tile.x1; ++u) {
        const bool counts = !marked || marked[u] > 0;
        out[u] = counts ? float(std::clamp(pixel_error(x, a, b, y * x.pitch + u), -most, most)) : 0.0f;
      }
    }
  }

 private:
  bool squares() const {
    return measure == Measure::squared || measure == Measure::relative || measure == Measure::relative_mean ||
           measure == Measure::mrse;
  }

  // Images of one size have one pitch, so a pixel is at the same place in all of them.
  double pixel_error(const quell_image& x, const quell_image& a, const quell_image& b, std::ptrdiff_t at) const {
    double mean = 0, sum = 0;
    for (int c = 0; c < x.channels && measure == Measure::relative_mean; ++c)
      mean += 0.5 * (double(a.plane[c][at]) + b.plane[c][at]) / x.channels;
    for (int c = 0; c < x.channels; ++c) sum += error(x.plane[c][at], a.plane[c][at], b.plane[c][at], mean);
    return sum / x.channels;
  }

  double error(double x, double a, double b, double mean) const {
    const double y = 0.5 * (a + b), square = (x - a) * (x - b), eps = epsilon;
    switch (measure) {
      case Measure::squared:
        return square;
      case Measure::absolute:
        return std::abs(x - y);
      case Measure::plain:
        return x - y;
      case Measure::relative:
        return ratio(square, y * y + eps);
      case Measure::relative_mean:
        return ratio(square, mean * mean + eps);
      case Measure::mrse:
        return ratio(square, (std::abs(y) + eps) * (std::abs(y) + eps));
      case Measure::smape:
        return ratio(std::abs(x - y), std::abs(x) + std::abs(y) + eps);
      case Measure::mape:
        return ratio(std::abs(x - y), std::abs(y) + eps);
    }
    return 0;
  }
  static double ratio(double over, double under) { return over == 0 ? 0 : over / under; }
};

}  // namespace
QUELL_PLUGIN("difference", Difference)
