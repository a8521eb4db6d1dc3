// 4x4 matrices from tables, in double: world coordinates times pixels per radian need more digits than a float has.
#pragma once

#include <quell/tile.h>

#include <algorithm>

#include <glm/glm.hpp>

namespace quell {

// Row-major in the table, for column vectors.
inline glm::dmat4 matrix(const quell_image& table, int index) {
  const float* m = table.plane[0] + index * table.pitch;
  glm::dmat4 out;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) out[column][row] = m[4 * row + column];
  return out;
}

inline bool same_matrix(const quell_image& a, const quell_image& b, int index) {
  const float* m = a.plane[0] + index * a.pitch;
  return std::equal(m, m + 16, b.plane[0] + index * b.pitch);
}

// The linear part of the rows x, y and w of a world-to-screen matrix: directions to homogeneous pixels.
inline glm::dmat3 directions(const glm::dmat4& screen) {
  glm::dmat3 out;
  for (int column = 0; column < 3; ++column)
    out[column] = glm::dvec3(screen[column][0], screen[column][1], screen[column][3]);
  return out;
}

}  // namespace quell
