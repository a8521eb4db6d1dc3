// The kernel of temporal_blend.
#pragma once

namespace quell {

struct BlendRule {
  float alpha;
  bool warm_up;
};

// Pixels [x0, x1) of one channel; rows at pixel x = 0. `factor` on alpha may be nullptr.
void blend_row(const BlendRule&, int x0, int x1, const float* current, const float* history, const float* count,
               const float* factor, float* out);

}  // namespace quell
