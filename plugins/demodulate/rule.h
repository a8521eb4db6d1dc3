// What radiance is divided by, and irradiance multiplied by: one rule for demodulate and modulate, so that they are
// inverses.
#pragma once

#include <quell/describe.h>

#include <cstdint>

namespace quell::demodulation {

enum class Mode : std::int32_t { clip, classic, asymmetric };

struct Rule {
  Mode mode = Mode::clip;
  float floor = 0.1f;
  float ceiling = 1.0f;

  void describe(Describe& d) {
    d.param(
        mode, "mode",
        "clip: divides by albedo clipped to [floor, ceiling]. classic: divides by max(albedo, 0.001), and not at all "
        "where all three channels are below 0.001 or one is above 1, which mixes both kinds of light between "
        "neighbours. asymmetric: divides by max(albedo, 0.001) and multiplies by albedo itself, as Falcor does; what "
        "has no albedo comes out black, so modulate is no inverse there.",
        {"clip", "classic", "asymmetric"});
    d.param(floor, "floor", "Smallest divisor of mode clip, albedo.").range(1e-4, 1);
    d.param(ceiling, "ceiling", "Largest divisor of mode clip, albedo.").range(1, 100);
  }
};

}  // namespace quell::demodulation
