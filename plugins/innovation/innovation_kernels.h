// The kernel of innovation.
#pragma once

#include "disocclusion/taps.h"

namespace quell {

struct Newness {
  TapsRow taps;
  quell_image before;
  // Of each channel the rows above, here and below, one after another, at pixel x = 0; pixels beside the image repeat
  // those at its border.
  const float* const* around;
  float tolerance, share;
};

// Pixels [x0, x1) of the row.
void innovation_row(const Newness&, int x0, int x1, float* out);

}  // namespace quell
