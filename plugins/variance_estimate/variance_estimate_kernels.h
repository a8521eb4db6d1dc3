// The kernel of variance_estimate: one tile.
#pragma once

#include <quell/taps.h>

namespace quell {

struct Estimate {
  Gather gather;  // of the image's three channels, then the two moments
  const float* count;
  float min_count;
  float* image[3];
  float* variance;
};

void variance_estimate_tile(const Estimate&, const quell_tile&);

}  // namespace quell
