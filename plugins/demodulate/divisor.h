// What radiance is divided by, and irradiance multiplied by: one rule for demodulate and modulate, so that they are
// inverses.
#pragma once

#include <quell/describe.h>

#include <algorithm>
#include <cstdint>

namespace quell::demodulation {

enum class Mode : std::int32_t { clip, classic };

// Below this albedo the usual demodulation takes a surface for black (Falcor's SVGF uses the same number).
inline constexpr float kBlack = 1e-3f;

struct Rule {
  Mode mode = Mode::clip;
  float floor = 0.1f;

  void describe(Describe& d) {
    d.param(mode, "mode",
            "clip: divides by albedo clipped to [floor, 1]. classic: divides by max(albedo, 0.001), and not at all "
            "where all "
            "three channels are below 0.001 or one is above 1, which mixes both kinds of light between neighbours.",
            {"clip", "classic"});
    d.param(floor, "floor", "Smallest divisor of mode clip.").range(1e-4, 1);
  }

  void divisor(const float albedo[3], float divisor[3]) const {
    if (mode == Mode::clip) {
      for (int c = 0; c < 3; ++c) divisor[c] = std::min(std::max(albedo[c], floor), 1.0f);
      return;
    }
    const float brightest = std::max({albedo[0], albedo[1], albedo[2]});
    const bool plain = brightest < kBlack || brightest > 1;
    for (int c = 0; c < 3; ++c) divisor[c] = plain ? 1.0f : std::max(albedo[c], kBlack);
  }
};

}  // namespace quell::demodulation
