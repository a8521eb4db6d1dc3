// Shows object numbers as colours that tell neighbours apart.
#include <quell/node.h>

namespace {

struct IdColor {
  quell::In<quell::Id> id;
  quell::Out<quell::Display> display;

  void describe(quell::Describe& d) {
    d.summary("Shows each object number as a colour of its own; equal numbers have equal colours in every frame.");
    d.source("Wellons 2018, Hash Function Prospecting: the 32-bit mixer lowbias32.");
    d.in(id, "id", "Object numbers.");
    d.out(display, "image", "Colours for an sRGB display, none darker than a quarter; black where nothing was hit.");
  }

  void run(const quell::Tile& tile) const {
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const std::uint32_t object = tile.bits(id, 0, y)[x];
        const std::uint32_t bits = mixed(object + 1);  // for 0 is mixed to 0
        for (int c = 0; c < 3; ++c) {
          const auto byte = float(bits >> (8 * c) & 0xFF);
          tile.row(display, c, y)[x] = object == quell::kNoId ? 0.0f : 0.25f + 0.75f * (byte / 255);
        }
      }
  }

 private:
  static std::uint32_t mixed(std::uint32_t v) {
    v = (v ^ v >> 16) * 0x7feb352du;
    v = (v ^ v >> 15) * 0x846ca68bu;
    return v ^ v >> 16;
  }
};

}  // namespace
QUELL_PLUGIN("id_color", IdColor)
