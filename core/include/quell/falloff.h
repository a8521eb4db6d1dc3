// How a weight falls with distance: the functions that every weight node of a measured distance offers, by name.
//
// A node holds `quell::Falloff falloff`, calls describe_falloff in `describe`, and in its kernel with_falloff of
// <quell/weights.h>, where the same functions are exponents.
#pragma once

#include <cstdint>

namespace quell {

// K(x) of x = D / sigma. All are 1 at 0, fall from there and are never negative.
enum class Falloff : std::int32_t { gaussian, exponential, cosine, tent, smoothstep, rational, step };

// D is what the node's weight output documents.
template <class Describe>
void describe_falloff(Describe& d, Falloff& falloff) {
  d.param(falloff, "falloff",
          "How the weight falls with x = D / sigma. gaussian: exp(-x² / 2). exponential: exp(-x). rational: "
          "1 / (1 + 3x + 9x²), whose tail is long. cosine: cos(πx / 2), tent: 1 - x, smoothstep: 1 - x² (3 - 2x), "
          "step: 1; these four are 0 from x = 1 on.",
          {"gaussian", "exponential", "cosine", "tent", "smoothstep", "rational", "step"});
}

}  // namespace quell
