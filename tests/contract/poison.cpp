// What a tile may read of its inputs, and the rest made unreadable.
#include "tests/contract/poison.h"

namespace quell::test {

namespace {

// A quiet NaN, and not the one of untouched outputs: what is computed from it counts as written.
constexpr std::uint32_t kPoison = 0x7FC0BEEFu;

}  // namespace

void poison(Use& use, const Rect& tile, const quell_shape& extent, const quell_reach& around) {
  each_image(use, around, [&](Image& image, int type, const quell_reach& r) {
    if (!is_pixels(type) || r.anywhere || image.width() != extent.width || image.height() != extent.height) return;
    const Rect allowed{tile.x0 - r.left, tile.y0 - r.up, tile.x1 + r.right, tile.y1 + r.down};
    for (int c = 0; c < image.channels(); ++c)
      for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
          if (!allowed.holds(x, y)) image.bits(c, y)[x] = kPoison;
  });
}

}  // namespace quell::test
