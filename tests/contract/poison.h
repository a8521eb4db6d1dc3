// What a tile may read of its inputs, and the rest made unreadable.
#pragma once

#include "tests/contract/use.h"

namespace quell::test {

inline quell_reach sum(const quell_reach& a, const quell_reach& b) {
  return {a.left + b.left, a.right + b.right, a.up + b.up, a.down + b.down, a.anywhere | b.anywhere, 0};
}

// Calls visit(image, type, reach) for every image that a use reads, those of its weight nodes included, whose reach is
// that of the port that takes them plus their own.
template <class F>
void each_image(Use& use, const quell_reach& around, F&& visit) {
  const auto reach = use.instance.reach();
  for (std::size_t i = 0; i < use.in.size(); ++i) {
    const auto r = sum(reach[i], around);
    for (auto& image : use.in[i].images) visit(image, use.in[i].type, r);
    for (auto& weight : use.in[i].weights) each_image(weight, r, visit);
  }
}

// Sets every input pixel that the tile of an output of this size may not read to NaN (integers: to a number that no
// image has). Images of another size are left alone.
void poison(Use&, const Rect& tile, const quell_shape& extent, const quell_reach& around = {});

}  // namespace quell::test
