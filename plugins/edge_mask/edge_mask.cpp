// Where surfaces meet: the region that filters blur.
#include <quell/node.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace {

struct EdgeMask {
  quell::In<quell::Id> id;
  quell::In<quell::Normal> normal;
  quell::In<quell::Depth> depth;
  quell::Out<quell::Scalar> mask;
  int radius = 1;
  float normal_cosine = 0.9f, depth_ratio = 0.1f;

  void describe(quell::Describe& d) {
    d.summary("Marks pixels near an edge of what is shown, by whichever guides are wired.");
    d.source("Quell: two pixels within the radius that differ in a guide make an edge.");
    d.in(id, "id", "An edge is where objects differ.").optional().halo(radius);
    d.in(normal, "normal", "An edge is where normals stand at a wide angle; a miss differs from every surface.")
        .optional()
        .halo(radius);
    d.in(depth, "depth", "An edge is where depths differ by much; a miss differs from every surface.")
        .optional()
        .halo(radius);
    d.out(mask, "mask", "1 where a pixel within the radius differs from this one, else 0.");
    d.param(radius, "radius", "How far an edge reaches, pixels in x and y.").range(1, 16);
    d.param(normal_cosine, "normal_cosine", "Cosine of the angle from which on normals differ.").range(-1, 1);
    d.param(depth_ratio, "depth_ratio", "Depths differ where |d − d'| is more than this share of the nearer one.")
        .range(0, 1e6);
  }

  void shapes(const quell_spec& spec, quell_shape* out) const {
    for (const int port : {id.index, normal.index, depth.index})
      if (spec.in_count[port]) {
        out[mask.index] = {spec.in[port].width, spec.in[port].height, 1};
        return;
      }
    throw std::runtime_error("an edge is one of id, normal or depth: connect at least one of them");
  }

  void run(const quell::Tile& tile) const {
    const quell_image& size = tile[mask];
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        bool edge = false;
        for (int v = std::max(0, y - radius); v <= std::min(size.height - 1, y + radius) && !edge; ++v)
          for (int u = std::max(0, x - radius); u <= std::min(size.width - 1, x + radius) && !edge; ++u)
            edge = differ(tile, x, y, u, v);
        tile.row(mask, 0, y)[x] = edge ? 1.0f : 0.0f;
      }
  }

 private:
  bool differ(const quell::Tile& tile, int x, int y, int u, int v) const {
    if (tile.has(id) && tile.bits(id, 0, y)[x] != tile.bits(id, 0, v)[u]) return true;
    if (tile.has(normal)) {
      double cosine = 0, here = 0, there = 0;
      for (int c = 0; c < 3; ++c) {
        const double a = tile.row(normal, c, y)[x], b = tile.row(normal, c, v)[u];
        cosine += a * b, here += a * a, there += b * b;
      }
      if ((here == 0) != (there == 0) || (here > 0 && cosine < normal_cosine)) return true;
    }
    if (!tile.has(depth)) return false;
    const double a = tile.row(depth, 0, y)[x], b = tile.row(depth, 0, v)[u];
    return std::abs(a - b) > depth_ratio * std::min(a, b);
  }
};

}  // namespace
QUELL_PLUGIN("edge_mask", EdgeMask)
