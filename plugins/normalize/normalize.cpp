// Gives normals their length back, which averages of them have lost.
#include <quell/node.h>

#include <cmath>

namespace {

struct Normalize {
  quell::In<quell::Normal> normal;
  quell::Out<quell::Normal> unit;

  void describe(quell::Describe& d) {
    d.summary("Divides normals by their length.");
    d.in(normal, "normal", "Normals of any length, as filters and antialiasing leave them.");
    d.out(unit, "normal", "Unit normals; (0,0,0), a miss, where they were shorter than 1e-3.").passes(normal);
  }

  void run(const quell::Tile& tile) const {
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float *nx = tile.row(normal, 0, y), *ny = tile.row(normal, 1, y), *nz = tile.row(normal, 2, y);
      float *ux = tile.row(unit, 0, y), *uy = tile.row(unit, 1, y), *uz = tile.row(unit, 2, y);
      for (int x = tile.x0; x < tile.x1; ++x) {
        const float length = std::sqrt(nx[x] * nx[x] + ny[x] * ny[x] + nz[x] * nz[x]);
        const float scale = length >= 1e-3f ? 1 / length : 0;
        ux[x] = nx[x] * scale, uy[x] = ny[x] * scale, uz[x] = nz[x] * scale;
      }
    }
  }
};

}  // namespace
QUELL_PLUGIN("normalize", Normalize)
