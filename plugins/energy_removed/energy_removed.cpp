// Says how much light a node took away: what every clamp of outliers owes its user.
#include <quell/node.h>

#include <cmath>

namespace {

struct EnergyRemoved {
  quell::In<quell::Radiance> before, after;
  quell::Out<quell::Value> energy, share, changed;

  void describe(quell::Describe& d) {
    d.summary("Measures the light that lies between two images: how much a clamp of outliers takes away.");
    d.in(before, "before", "Radiance before.").anywhere();
    d.in(after, "after", "Radiance after.").anywhere();
    d.out(energy, "energy", "Mean luminance (0.2126, 0.7152, 0.0722) of before − after, radiance a pixel.");
    d.out(share, "share", "That as a share of the mean luminance before; 0 where there is no light.");
    d.out(changed, "changed", "Share of the pixels that differ in any channel.");
  }

  // Rows are summed in double, and then their sums from the top down: the same bits however the work is split.
  void run(const quell::Tile& tile) const {
    const quell_image& image = tile[before];
    double first = 0, taken = 0, differ = 0;
    for (int y = 0; y < image.height; ++y) {
      const float *r = tile.row(before, 0, y), *g = tile.row(before, 1, y), *b = tile.row(before, 2, y);
      const float *r2 = tile.row(after, 0, y), *g2 = tile.row(after, 1, y), *b2 = tile.row(after, 2, y);
      double row_first = 0, row_taken = 0;
      int row_differ = 0;
      for (int x = 0; x < image.width; ++x) {
        row_first += luminance(r[x], g[x], b[x]);
        row_taken += luminance(double(r[x]) - r2[x], double(g[x]) - g2[x], double(b[x]) - b2[x]);
        row_differ += (r[x] != r2[x]) | (g[x] != g2[x]) | (b[x] != b2[x]);
      }
      first += row_first, taken += row_taken, differ += row_differ;
    }
    const double pixels = double(image.width) * image.height;
    write(tile, energy, taken / pixels);
    write(tile, share, first > 0 ? taken / first : 0);
    write(tile, changed, differ / pixels);
  }

 private:
  static double luminance(double r, double g, double b) { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }
  static void write(const quell::Tile& tile, quell::Out<quell::Value> port, double value) {
    // Images that were not finite have no energy.
    tile.row(port, 0, 0)[0] = std::isfinite(float(value)) ? float(value) : 0;
  }
};

}  // namespace
QUELL_PLUGIN("energy_removed", EnergyRemoved)
