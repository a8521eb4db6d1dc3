// Brings radiance to a scale on which differences are as visible as they are large.
#include <quell/node.h>

#include "encode/encode_kernels.h"

namespace {

struct Encode {
  quell::In<quell::Radiance> image;
  quell::Out<quell::Features> encoded;
  quell::Curve curve = quell::Curve::compress;

  void describe(quell::Describe& d) {
    d.summary(
        "Maps each channel of radiance to [0,1] by a curve that an eye's response resembles, for metrics. `tonemap` "
        "with its encodings is for displays.");
    d.source(
        "pu: the perceptually uniform transfer function of Open Image Denoise, a fit of Aydin et al. 2008, Extending "
        "Quality Metrics to Full Luminance Range Images.");
    d.in(image, "image", "Radiance; negative numbers count as 0.");
    d.out(encoded, "image", "The three channels in [0,1].");
    d.param(curve, "curve",
            "compress: x / (1 + x). pu: about 0.215 for 0.18, 0.319 for 1 and 1 for 65504 and more, a line near black "
            "and a logarithm far from it; expose the image first.",
            {"compress", "pu"});
  }

  void shapes(const quell_spec& spec, quell_shape* out) const { out[encoded.index] = spec.in[image.index]; }

  void run(const quell::Tile& tile) const {
    for (int c = 0; c < 3; ++c)
      for (int y = tile.y0; y < tile.y1; ++y)
        quell::encode_row(curve, tile.x0, tile.x1, tile.row(image, c, y), tile.row(encoded, c, y));
  }
};

}  // namespace
QUELL_PLUGIN("encode", Encode)
