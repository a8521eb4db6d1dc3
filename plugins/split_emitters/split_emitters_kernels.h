// The kernel of split_emitters.
#pragma once

namespace quell {

// Rows at pixel x = 0; those of inputs that are not connected, and of outputs that do not exist, are nullptr.
struct SplitRow {
  const float *color[3], *albedo[3], *emission[3], *normal[3], *depth;
  float *lit[3], *aside[3], *normal_out[3], *depth_out;
  bool keep;  // set nothing aside but the given emission
};

// Pixels [x0, x1).
void split_emitters(const SplitRow&, int x0, int x1);

}  // namespace quell
