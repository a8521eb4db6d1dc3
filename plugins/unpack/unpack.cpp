// Takes an image back out of those that `pack` joined.
#include <quell/node.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace {

struct Unpack {
  quell::In<quell::Features> packed;
  quell::In<quell::Any> like;
  quell::Out<quell::Any> image;
  int first = 0;

  void describe(quell::Describe& d) {
    d.summary("Takes an image out of a packed one, as one of the type and the number of channels of another.");
    d.in(packed, "image", "Channels as `pack` joined them, filtered or not.");
    d.in(like, "like", "Says what comes out: usually the image that went into `pack`. Its pixels are not read.");
    d.out(image, "image", "As many channels as `like` has, of its type.").passes(like);
    d.param(first, "first", "Channel of the packed image that becomes the first one of the output, from 0.")
        .range(0, 4095);
  }

  void shapes(const quell_spec& spec, quell_shape* out) const {
    const quell_shape& from = spec.in[packed.index];
    const int channels = spec.in[like.index].channels;
    if (first + channels > from.channels) {
      const auto n = [](int i) { return std::to_string(i); };
      throw std::runtime_error("channels " + n(first) + " to " + n(first + channels - 1) +
                               " are asked for ('like' has " + n(channels) + "), but 'image' has " + n(from.channels) +
                               ", counted from 0");
    }
    out[image.index] = {from.width, from.height, channels};
  }

  void run(const quell::Tile& tile) const {
    for (int c = 0; c < tile[image].channels; ++c)
      for (int y = tile.y0; y < tile.y1; ++y) {
        const float* row = tile.row(packed, first + c, y);
        std::copy(row + tile.x0, row + tile.x1, tile.row(image, c, y) + tile.x0);
      }
  }
};

}  // namespace
QUELL_PLUGIN("unpack", Unpack)
