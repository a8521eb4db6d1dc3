// Colour to one number: the grey of a picture.
#include <quell/node.h>

#include <stdexcept>
#include <string>

namespace {

enum class Weights : std::int32_t { rec709, rec601 };

struct Luminance {
  quell::In<quell::Any> image;
  quell::Out<quell::Scalar> grey;
  Weights weights = Weights::rec709;

  void describe(quell::Describe& d) {
    d.summary(
        "Weighs red, green and blue to one number: the luminance of linear light, the luma of what a display shows.");
    d.source("ITU-R BT.709 and BT.601, the weights of their luma.");
    d.in(image, "image", "Three channels, red, green and blue.");
    d.out(grey, "image", "The sum, in the image's unit.");
    d.param(weights, "weights",
            "rec709: 0.2126 R + 0.7152 G + 0.0722 B, luminance of linear Rec. 709 and sRGB primaries. rec601: 0.299 R "
            "+ 0.587 G + 0.114 B, which is what image libraries call grey (rgb2gray of MATLAB, cvtColor of OpenCV, L "
            "of Pillow), taken of encoded values.",
            {"rec709", "rec601"});
  }

  void shapes(const quell_spec& spec, quell_shape* out) const {
    const auto& s = spec.in[image.index];
    if (s.channels != 3)
      throw std::runtime_error("image has " + std::to_string(s.channels) +
                               " channels, but luminance is of three: red, green and blue");
    out[grey.index] = {s.width, s.height, 1};
  }

  void run(const quell::Tile& tile) const {
    const bool wide = weights == Weights::rec709;
    const double r = wide ? 0.2126 : 0.299, g = wide ? 0.7152 : 0.587, b = wide ? 0.0722 : 0.114;
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float *red = tile.row(image, 0, y), *green = tile.row(image, 1, y), *blue = tile.row(image, 2, y);
      float* const out = tile.row(grey, 0, y);
      for (int x = tile.x0; x < tile.x1; ++x) out[x] = float(r * red[x] + g * green[x] + b * blue[x]);
    }
  }
};

}  // namespace
QUELL_PLUGIN("luminance", Luminance)
