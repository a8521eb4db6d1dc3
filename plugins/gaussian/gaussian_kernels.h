// The kernel of gaussian: columns into a row that stays in the cache, then along that row.
#pragma once

#include <quell/abi.h>

#include <vector>

namespace quell {

struct Blur {
  int radius;
  std::vector<float> kernel;  // 2 radius + 1 weights
  std::vector<float> across;  // for each column of the tile: 1 / sum of the weights that fall into the image
  std::vector<float> along;   // for each row of the tile, the same
  std::vector<float> row;     // room for one row of the tile, with `radius` columns on both sides, and kPad more

  static constexpr int kPad = 64;  // vectors are stored whole, four at a time
};

void gaussian_tile(Blur&, const quell_tile&, const quell_image& in, const quell_image& out);

}  // namespace quell
