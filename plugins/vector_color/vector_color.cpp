// Shows three signed numbers a pixel as red, green and blue.
#include <quell/node.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace {

enum class Wrap : std::int32_t { signed_, repeat };

struct VectorColor {
  quell::In<quell::Any> image;
  quell::Out<quell::Display> display;
  Wrap mode = Wrap::signed_;
  float unit = 1;

  void describe(quell::Describe& d) {
    d.summary("Shows the three channels of normals or positions as red, green and blue.");
    d.source("v · ½ + ½, as renderers show normals; v − ⌊v⌋.");
    d.in(image, "image",
         "An image of three channels. Pixels that are (0,0,0), as where nothing was hit, become black.");
    d.out(display, "image", "Colours for an sRGB display.");
    d.param(mode, "mode", "signed: -unit is dark, 0 is grey and unit bright. repeat: from dark to bright in each unit.",
            {"signed", "repeat"});
    d.param(unit, "unit", "Length, in the image's unit.").range(1e-6, 1e6);
  }

  void shapes(const quell_spec& spec, quell_shape*) const {
    // Zero before the shape is known.
    if (const int channels = spec.in[image.index].channels; channels > 0 && channels != 3)
      throw std::runtime_error("an image of 3 channels is wanted, not of " + std::to_string(channels));
  }

  void run(const quell::Tile& tile) const {
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        float v[3];
        for (int c = 0; c < 3; ++c) v[c] = tile.row(image, c, y)[x];
        const bool nothing = v[0] == 0 && v[1] == 0 && v[2] == 0;
        for (int c = 0; c < 3; ++c) tile.row(display, c, y)[x] = nothing ? 0.0f : shown(v[c] / unit);
      }
  }

 private:
  float shown(float v) const {
    return std::clamp(mode == Wrap::repeat ? v - std::floor(v) : 0.5f + 0.5f * v, 0.0f, 1.0f);
  }
};

}  // namespace
QUELL_PLUGIN("vector_color", VectorColor)
