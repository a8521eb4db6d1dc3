// Numbers about an image, one of each a frame.
#include <quell/node.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

struct Statistics {
  quell::In<quell::Any> image;
  quell::Out<quell::Value> mean, minimum, maximum, deviation, invalid;

  void describe(quell::Describe& d) {
    d.summary("Mean, range and deviation of an image, over all pixels and channels.");
    d.in(image, "image", "Any image. Numbers that are not finite are counted and otherwise left out.").anywhere();
    d.out(mean, "mean", "Mean of the finite numbers, 0 if there are none.");
    d.out(minimum, "minimum", "The least of them.");
    d.out(maximum, "maximum", "The greatest of them.");
    d.out(deviation, "deviation", "Their standard deviation about the mean.");
    d.out(invalid, "invalid", "How many numbers are not finite.");
  }

  // Rows are summed in double, and then their sums from the top down: the same bits however the work is split.
  void run(const quell::Tile& tile) const {
    const quell_image& in = tile[image];
    float least = std::numeric_limits<float>::infinity(), most = -least;
    double sum = 0, count = 0;
    each_row(in, [&](const float* row) {
      double of_row = 0;
      int finite = 0;
      for (int x = 0; x < in.width; ++x) {
        if (!std::isfinite(row[x])) continue;
        of_row += row[x], ++finite;
        least = std::min(least, row[x]), most = std::max(most, row[x]);
      }
      sum += of_row, count += finite;
    });
    const double middle = count > 0 ? sum / count : 0;
    double squares = 0;
    each_row(in, [&](const float* row) {
      double of_row = 0;
      for (int x = 0; x < in.width; ++x)
        if (std::isfinite(row[x])) of_row += (row[x] - middle) * (row[x] - middle);
      squares += of_row;
    });
    const double all = double(in.width) * in.height * in.channels;
    write(tile, mean, middle);
    write(tile, minimum, count > 0 ? least : 0);
    write(tile, maximum, count > 0 ? most : 0);
    write(tile, deviation, count > 0 ? std::sqrt(squares / count) : 0);
    write(tile, invalid, all - count);
  }

 private:
  template <class Visit>
  static void each_row(const quell_image& in, Visit visit) {
    for (int c = 0; c < in.channels; ++c)
      for (int y = 0; y < in.height; ++y) visit(in.plane[c] + y * in.pitch);
  }
  static void write(const quell::Tile& tile, quell::Out<quell::Value> port, double value) {
    constexpr double most = std::numeric_limits<float>::max();
    tile.row(port, 0, 0)[0] = float(std::clamp(value, -most, most));
  }
};

}  // namespace
QUELL_PLUGIN("statistics", Statistics)
