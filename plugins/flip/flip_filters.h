// The numbers of FLIP that depend on how many pixels an eye sees to a degree: filters, cut into rows and columns.
#pragma once

#include <vector>

namespace quell {

// Weights of 2·radius + 1 taps each. Every two-dimensional kernel of FLIP is a product of a row and a column, or a sum
// of two of these.
struct FlipFilters {
  int radius = 0;
  // Contrast sensitivity to lightness, red-green and blue-yellow; the last is a sum of two.
  std::vector<float> lightness, red_green, blue_yellow[2], blue_yellow_column[2];
  // A Gaussian and its first and second derivative, whose positive weights sum to 1 and negative ones to -1.
  std::vector<float> gauss, edge, point;
  // Linear Rec. 709 to XYZ over that of white, and back; row-major.
  float to_xyz[9], to_rgb[9];
};

// Radius of the widest of them, pixels.
int flip_radius(double pixels_per_degree);
FlipFilters flip_filters(double pixels_per_degree);

}  // namespace quell
