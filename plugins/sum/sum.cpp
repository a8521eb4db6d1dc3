// Adds images: the parts of light that were filtered apart.
#include <quell/node.h>

#include "sum/sum_kernels.h"

namespace {

struct Sum {
  quell::InList<quell::Any> images;
  quell::Out<quell::Any> total;

  void describe(quell::Describe& d) {
    d.summary("Adds images of one type, channel by channel.");
    d.in(images, "images", "One or more, of equal channels.");
    d.out(total, "image", "Their sum, in the order of the list.");
  }

  void run(const quell::Tile& tile) const {
    const auto list = tile[images];
    const auto& out = tile[total];
    for (int c = 0; c < out.channels; ++c)
      for (int y = tile.y0; y < tile.y1; ++y)
        for (std::size_t i = 0; i < list.size(); ++i) {
          float* const to = tile.row(total, c, y);
          const float* const from = list[i].plane[c] + y * list[i].pitch;
          quell::add_row(i ? to : nullptr, from, to, tile.x0, tile.x1);
        }
  }
};

}  // namespace
QUELL_PLUGIN("sum", Sum)
