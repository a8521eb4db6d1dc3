// How fast depth changes from pixel to pixel on the surface that the pixel shows, so that depth tests can allow for it.
#include <quell/node.h>

#include <cmath>

namespace {

// On a plane, 1/depth is linear in the pixel, so the two one-sided differences differ by about slope / depth of their
// sum. A quarter is far above that for all but grazing surfaces, and below any crease that is worth keeping.
constexpr float kBend = 0.25f;

bool hit(float z) { return z < 0.5f * quell::kFar; }

// The slope at `here` from the depths on either side; a side outside the image comes as kFar.
float slope_of(float before, float here, float after) {
  if (!hit(here)) return 0;
  const float left = here - before, right = after - here;
  if (!hit(before)) return hit(after) ? right : 0;
  if (!hit(after)) return left;
  if (std::abs(right - left) <= kBend * (std::abs(left) + std::abs(right))) return 0.5f * (left + right);
  return std::abs(left) <= std::abs(right) ? left : right;
}

struct DepthSlope {
  quell::In<quell::Depth> depth;
  quell::Out<quell::Slope> slope;

  void describe(quell::Describe& d) {
    d.summary(
        "Slope of depth, per pixel: the central difference inside a surface; beside a miss, an edge or a crease the "
        "smaller "
        "one-sided one; 0 at a miss.");
    d.source(
        "Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, section 4.4: the gradient in the depth weight.");
    d.in(depth, "depth", "Depth; 1e30 is a miss.").halo(1);
    d.out(slope, "slope", "d depth/dx and d depth/dy, scene units per pixel.");
  }

  void run(const quell::Tile& tile) const {
    const auto& image = tile[depth];
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float* here = tile.row(depth, 0, y);
      const float* above = y > 0 ? tile.row(depth, 0, y - 1) : nullptr;
      const float* below = y + 1 < image.height ? tile.row(depth, 0, y + 1) : nullptr;
      float* dx = tile.row(slope, 0, y);
      float* dy = tile.row(slope, 1, y);
      for (int x = tile.x0; x < tile.x1; ++x) {
        const float left = x > 0 ? here[x - 1] : quell::kFar;
        const float right = x + 1 < image.width ? here[x + 1] : quell::kFar;
        dx[x] = slope_of(left, here[x], right);
        dy[x] = slope_of(above ? above[x] : quell::kFar, here[x], below ? below[x] : quell::kFar);
      }
    }
  }
};

}  // namespace
QUELL_PLUGIN("depth_slope", DepthSlope)
