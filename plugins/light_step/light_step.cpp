// Finds the pixels around which light has changed at once, by a picture without noise.
#include <quell/node.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

struct LightStep {
  quell::In<quell::Scalar> image, before, mask;
  quell::Out<quell::Scalar> step, direction;
  int radius = 3;
  float threshold = 0.25f;
  float floor = 0.01f;

  void describe(quell::Describe& d) {
    d.summary(
        "Marks the pixels around which light has changed from one frame to the next by more than a share of itself, as "
        "where a lamp was switched.");
    d.source(
        "Our own: a change of means over small windows, in which what a texture gains and loses by resampling along "
        "motion cancels.");
    d.in(image, "image", "Luminance of a frame without visible noise, as of a reference.").halo(radius);
    d.in(before, "before", "The same, one frame earlier, fetched along motion.").halo(radius);
    d.in(mask, "mask", "Pixels up to 0 have no past: they enter no mean and have no step.").halo(radius);
    d.out(step, "step", "Mean of image - before over the window where that is a step, upwards or downwards; else 0.");
    d.out(
        direction, "direction",
        "1 where light steps up, -1 where it steps down, else 0. Over a frame noise and reflections that pass cancel, "
        "so that the mean is the share of the frame that a lamp reaches.");
    d.param(radius, "radius", "Half-width of the window, pixels.").range(0, 32);
    d.param(threshold, "threshold", "Largest change that is none yet, as a share of the brighter of both means.")
        .range(0, 1);
    d.param(floor, "floor", "Largest change that is none yet, in the image's unit, however dark it is.").range(0, 1e6);
  }

  void run(const quell::Tile& tile) const {
    const quell_image& size = tile[image];
    const int from = std::max(tile.x0 - radius, 0), to = std::min(tile.x1 + radius, size.width);
    std::vector<Sums> column(std::size_t(to - from));
    for (int y = tile.y0; y < tile.y1; ++y) {
      std::ranges::fill(column, Sums{});
      for (int v = std::max(y - radius, 0); v <= std::min(y + radius, size.height - 1); ++v) {
        const float *now = tile.row(image, 0, v), *then = tile.row(before, 0, v), *known = tile.row(mask, 0, v);
        for (int u = from; u < to; ++u)
          if (known[u] > 0) column[std::size_t(u - from)].add({1, double(now[u]), double(then[u])});
      }
      for (int x = tile.x0; x < tile.x1; ++x) {
        Sums around;
        for (int u = std::max(x - radius, from); u <= std::min(x + radius, to - 1); ++u)
          around.add(column[std::size_t(u - from)]);
        const double change = tile.row(mask, 0, y)[x] > 0 ? step_of(around) : 0;
        tile.row(step, 0, y)[x] = float(change);
        tile.row(direction, 0, y)[x] = change > 0 ? 1.0f : change < 0 ? -1.0f : 0.0f;
      }
    }
  }

 private:
  struct Sums {
    double pixels = 0, now = 0, then = 0;
    void add(const Sums& s) { pixels += s.pixels, now += s.now, then += s.then; }
  };
  double step_of(const Sums& s) const {
    const double now = s.now / s.pixels, then = s.then / s.pixels, change = now - then;
    return std::abs(change) > std::max(double(floor), double(threshold) * std::max(now, then)) ? change : 0;
  }
};

}  // namespace
QUELL_PLUGIN("light_step", LightStep)
