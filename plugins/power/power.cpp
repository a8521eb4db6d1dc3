// Arithmetic of values: roots, units and products of powers.
#include <quell/node.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

struct Power {
  quell::In<quell::Value> value, times;
  quell::Out<quell::Value> result;
  float exponent = 1, scale = 1;

  void describe(quell::Describe& d) {
    d.summary("Raises a value to a power: scale · times · value^exponent.");
    d.in(value, "value", "A negative one counts as 0, unless exponent is 1.").anywhere();
    d.in(times, "times", "A factor, so that nodes in a row make a product of powers; 1 without it.")
        .optional()
        .anywhere();
    d.out(result, "value", "The product; the largest float where that would overflow.").passes(value);
    d.param(exponent, "exponent", "A pure number; 0.5 is the square root.").range(0, 16);
    d.param(scale, "scale", "A factor, as 1000 for thousandths.").range(-1e6, 1e6);
  }

  void shapes(const quell_spec&, quell_shape* out) const { out[result.index] = {1, 1, 1}; }

  void run(const quell::Tile& tile) const {
    const double v = *tile.row(value, 0, 0), factor = tile.has(times) ? double(*tile.row(times, 0, 0)) : 1.0;
    const double power = exponent == 1 ? v : std::pow(std::max(v, 0.0), double(exponent));
    constexpr double most = std::numeric_limits<float>::max();
    *tile.row(result, 0, 0) = float(std::clamp(double(scale) * factor * power, -most, most));
  }
};

}  // namespace
QUELL_PLUGIN("power", Power)
