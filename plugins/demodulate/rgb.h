// Rows of the three channels of a colour.
#pragma once

#include <quell/tile.h>

#include <array>

namespace quell {

template <class T>
std::array<const float*, 3> rgb(const Tile& tile, In<T> port, int y) {
  return {tile.row(port, 0, y), tile.row(port, 1, y), tile.row(port, 2, y)};
}
template <class T>
std::array<float*, 3> rgb(const Tile& tile, Out<T> port, int y) {
  return {tile.row(port, 0, y), tile.row(port, 1, y), tile.row(port, 2, y)};
}

}  // namespace quell
