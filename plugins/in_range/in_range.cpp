// A region of a frame by what an image holds there: the dark, the moving.
#include <quell/node.h>

#include <cmath>

namespace {

// Farther than anything that an image holds, and a number that its shortest decimal form does not exceed.
constexpr float kMost = 0x1p127f;

struct InRange {
  quell::In<quell::Any> image;
  quell::In<quell::Value> from, to;
  quell::Out<quell::Scalar> mask;
  float low = -kMost, high = kMost;

  void describe(quell::Describe& d) {
    d.summary("Marks the pixels whose brightness, length or number lies in a range.");
    d.in(image, "image",
         "Of three channels the luminance (0.2126, 0.7152, 0.0722) counts, of two the length, and else the first.");
    d.in(from, "from", "A lower end that is found in each frame, as by percentile; it comes on top of low.")
        .optional()
        .anywhere();
    d.in(to, "to", "An upper end that is found in each frame; it comes on top of high.").optional().anywhere();
    d.out(mask, "mask", "1 where low ≤ number ≤ high and from ≤ number ≤ to, else 0.");
    d.param(low, "low", "Lower end, in the image's unit.").range(-kMost, kMost);
    d.param(high, "high", "Upper end, in the image's unit.").range(-kMost, kMost);
  }

  void run(const quell::Tile& tile) const {
    const double least = std::fmax(low, tile.has(from) ? *tile.row(from, 0, 0) : -kMost);
    const double most = std::fmin(high, tile.has(to) ? *tile.row(to, 0, 0) : kMost);
    const quell_image& i = tile[image];
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        // As a float, so that an end that percentile found includes its own pixel.
        const double v = float(number(i, y * i.pitch + x));
        tile.row(mask, 0, y)[x] = v >= least && v <= most ? 1.0f : 0.0f;
      }
  }

 private:
  static double number(const quell_image& i, std::ptrdiff_t at) {
    const double first = i.plane[0][at];
    if (i.channels == 2) return std::hypot(first, double(i.plane[1][at]));
    if (i.channels == 3) return 0.2126 * first + 0.7152 * i.plane[1][at] + 0.0722 * i.plane[2][at];
    return first;
  }
};

}  // namespace
QUELL_PLUGIN("in_range", InRange)
