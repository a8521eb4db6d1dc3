// The first half of a reduction: an image becomes a small one of averages, in parallel and in a fixed order.
#include <quell/node.h>

#include <cmath>

namespace {

struct BlockAverage {
  quell::In<quell::Any> image;
  quell::Out<quell::Scalar> blocks;
  int size = 16;

  void describe(quell::Describe& d) {
    d.summary(
        "Averages blocks of pixels to one pixel each: the luminance of an image of three channels, the first channel "
        "of "
        "any other. Numbers of 5e29 and more, as depth has where nothing was hit, are left out.");
    d.source("The bins of Open Image Denoise's automatic exposure.");
    d.in(image, "image", "What to average.").anywhere();
    d.out(blocks, "blocks", "A pixel a block, in the unit of the image; 0 where a block has nothing to average.");
    d.param(
         size, "size",
         "Side of a block at most, pixels. An image is cut into ceil(width / size) by ceil(height / size) blocks that "
         "differ by a pixel at most.")
        .range(1, 4096);
  }

  void shapes(const quell_spec& spec, quell_shape* out) const {
    const auto& s = spec.in[image.index];
    out[blocks.index] = {(s.width + size - 1) / size, (s.height + size - 1) / size, 1};
  }

  void run(const quell::Tile& tile) const {
    const auto& from = tile[image];
    const auto& to = tile[blocks];
    for (int by = tile.y0; by < tile.y1; ++by)
      for (int bx = tile.x0; bx < tile.x1; ++bx)
        to.plane[0][by * to.pitch + bx] =
            average(from, edge(bx, from.width, to.width), edge(bx + 1, from.width, to.width),
                    edge(by, from.height, to.height), edge(by + 1, from.height, to.height));
  }

 private:
  static int edge(int block, int pixels, int blocks) { return int(std::int64_t(block) * pixels / blocks); }

  static float average(const quell_image& from, int x0, int x1, int y0, int y1) {
    double sum = 0;
    std::int64_t count = 0;
    for (int y = y0; y < y1; ++y) {
      const float* row[3];
      for (int c = 0; c < 3; ++c) row[c] = from.plane[from.channels == 3 ? c : 0] + y * from.pitch;
      for (int x = x0; x < x1; ++x) {
        const double v = from.channels == 3 ? 0.2126 * row[0][x] + 0.7152 * row[1][x] + 0.0722 * row[2][x] : row[0][x];
        if (std::abs(v) < 0.5 * quell::kFar) sum += v, ++count;
      }
    }
    return count ? float(sum / double(count)) : 0.0f;
  }
};

}  // namespace
QUELL_PLUGIN("block_average", BlockAverage)
