// Replaces numbers that are none, and says where.
#include <quell/node.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace {

enum class Policy : std::int32_t { neighbours, zero, error };

struct Sanitize {
  quell::In<quell::Any> image;
  quell::Out<quell::Any> clean;
  quell::Out<quell::Scalar> repaired;
  Policy policy = Policy::neighbours;
  float limit = 65504.0f;
  bool negative = true;

  void describe(quell::Describe& d) {
    d.summary(
        "Replaces pixels that hold NaN, infinity or numbers beyond a limit. Files are repaired when they are read; "
        "this "
        "is for what nodes make.");
    d.in(image, "image", "Any image. A pixel is bad if any of its channels is.").halo(1);
    d.out(clean, "image", "The image, every channel of a bad pixel replaced.").passes(image);
    d.out(repaired, "repaired", "1 where a pixel was bad, else 0: its mean (statistics) is their share.");
    d.param(policy, "policy",
            "neighbours: the mean of the good pixels among the eight around, 0 where none is. zero: 0. error: the run "
            "ends and names the pixel.",
            {"neighbours", "zero", "error"});
    d.param(limit, "limit",
            "Magnitude beyond which a number is bad, in units of the image; the default is the largest half float.")
        .range(0.0f, 3.4e38f);
    d.param(negative, "negative", "Whether negative numbers are good. Set it to false for radiance and variance.");
  }

  void run(const quell::Tile& tile) const {
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const int channel = bad_channel(tile, x, y);
        if (channel >= 0 && policy == Policy::error) refuse(tile, x, y, channel);
        tile.row(repaired, 0, y)[x] = channel >= 0 ? 1.0f : 0.0f;
        for (int c = 0; c < tile[image].channels; ++c)
          tile.row(clean, c, y)[x] = channel < 0                    ? tile.row(image, c, y)[x]
                                     : policy == Policy::neighbours ? around(tile, x, y, c)
                                                                    : 0;
      }
  }

 private:
  bool good(float v) const { return std::abs(v) <= limit && (negative || v >= 0); }  // NaN is not

  // The first one that is bad, or -1.
  int bad_channel(const quell::Tile& tile, int x, int y) const {
    for (int c = 0; c < tile[image].channels; ++c)
      if (!good(tile.row(image, c, y)[x])) return c;
    return -1;
  }
  float around(const quell::Tile& tile, int x, int y, int c) const {
    const auto& in = tile[image];
    double sum = 0;
    int count = 0;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, in.height - 1); ++v)
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, in.width - 1); ++u)
        if (bad_channel(tile, u, v) < 0) sum += tile.row(image, c, v)[u], ++count;
    return count ? float(sum / count) : 0.0f;
  }
  [[noreturn]] void refuse(const quell::Tile& tile, int x, int y, int c) const {
    throw std::runtime_error("pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") has " +
                             std::to_string(tile.row(image, c, y)[x]) + " in channel " + std::to_string(c) +
                             ", counted from 0; policy neighbours or zero would replace it");
  }
};

}  // namespace
QUELL_PLUGIN("sanitize", Sanitize)
