// The scale on which signals are compared with their errors.
#include <quell/node.h>

#include <algorithm>
#include <cmath>

namespace {

// No error at all would be infinitely many.
constexpr double kMost = 1000;

struct Decibel {
  quell::In<quell::Value> error, peak;
  quell::Out<quell::Value> ratio;

  void describe(quell::Describe& d) {
    d.summary("Says how far a mean squared error lies below the square of a peak: PSNR = 10 log10(peak² / error).");
    d.in(error, "error", "A mean squared error. One that is unbiased may be 0 or negative by chance.").anywhere();
    d.in(peak, "peak", "The largest signal; 1 without it, as of encoded images.").optional().anywhere();
    d.out(ratio, "decibels", "dB, from -1000 to 1000; 1000 where the error is 0 or negative.");
  }

  void shapes(const quell_spec&, quell_shape* out) const { out[ratio.index] = {1, 1, 1}; }

  void run(const quell::Tile& tile) const {
    const double mse = *tile.row(error, 0, 0), p = tile.has(peak) ? double(*tile.row(peak, 0, 0)) : 1.0;
    const double db = mse <= 0 ? kMost : 10 * std::log10(p * p / mse);  // NaN stays NaN
    *tile.row(ratio, 0, 0) = float(std::clamp(db, -kMost, kMost));
  }
};

}  // namespace
QUELL_PLUGIN("decibel", Decibel)
