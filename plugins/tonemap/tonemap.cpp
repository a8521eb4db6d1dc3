// Brings radiance into the range of a display.
#include <quell/node.h>

#include "tonemap/tonemap_kernels.h"

namespace {

struct Tonemap {
  quell::In<quell::Radiance> image;
  quell::Out<quell::Display> display;
  quell::tone::Operator curve = quell::tone::Operator::clamp;
  quell::tone::Encoding encoding = quell::tone::Encoding::srgb;

  void describe(quell::Describe& d) {
    d.summary(
        "Maps linear Rec. 709 radiance to [0,1] by a simple operator and encodes it for an sRGB display. For previews "
        "and metrics; `display_transform` gives a studio's own view.");
    d.source(
        "Reinhard et al. 2002, Photographic Tone Reproduction, eq. 3; Hable 2010, Filmic Tonemapping; Narkowicz 2016, "
        "ACES Filmic Tone Mapping Curve; IEC 61966-2-1 (sRGB).");
    d.in(image, "image", "Radiance; 1 is what `clamp` shows as white. Scale it by `exposure` first.");
    d.out(display, "image",
          "Display values in [0,1]. With encoding `linear` they are not encoded, as HDR-FLIP takes them.");
    d.param(
        curve, "operator",
        "clamp: min(x, 1). reinhard: x / (1 + Y) with Y the Rec. 709 luminance, so hue stays. aces: a rational fit of "
        "the ACES view. hable: a film's toe and shoulder, white at 11.2. All end in a clamp to [0,1]; radiance "
        "above 65536 counts as that.",
        {"clamp", "reinhard", "aces", "hable"});
    d.param(encoding, "encoding", "srgb: the curve that sRGB displays undo. linear: none.", {"srgb", "linear"});
  }

  void run(const quell::Tile& tile) const {
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float* in[3];
      float* out[3];
      for (int c = 0; c < 3; ++c) in[c] = tile.row(image, c, y), out[c] = tile.row(display, c, y);
      quell::tonemap_row(curve, encoding, tile.x0, tile.x1, in, out);
    }
  }
};

}  // namespace
QUELL_PLUGIN("tonemap", Tonemap)
