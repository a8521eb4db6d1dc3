// Counts the frames that a picture takes to follow a step of light.
#include <quell/node.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace {

// What is carried along motion: how much of the pixel follows a step at all, and, multiplied by that so that
// neighbours mix in proportion, the step, frames since it, frames in which it was not reached, and whether it still is
// not.
enum State { kFollows, kStep, kAge, kFrames, kLagging, kStates };
// Less than this share of a pixel is left of its past by resampling: it is let go.
constexpr double kLeast = 1.0 / 64;

struct LightLag {
  quell::In<quell::Features> before;
  quell::In<quell::Scalar> step, error;
  quell::In<quell::Value> share;
  quell::Out<quell::Features> state;
  quell::Out<quell::Scalar> frames, lagging, stepped, over;
  float tolerance = 0.1f;
  float least = 0.05f;
  int window = 32;

  void describe(quell::Describe& d) {
    d.summary(
        "Counts for each pixel the frames from a step of light to the first in which the picture has come within a "
        "share of that step to its reference.");
    d.source(
        "Our own: the response time of control engineering, per pixel and along motion. An exponential average of "
        "weight alpha takes the least n with (1 - alpha)^(n + 1) < tolerance.");
    d.in(before, "before", "The state one frame earlier, fetched along motion; channels behind its own are not read.");
    d.in(step, "step", "By light_step: the change of light in this frame; 0 where there is none.");
    d.in(error, "error", "Mean around the pixel of the picture less its reference.");
    d.in(share, "share",
         "Share of the frame that steps up less that which steps down, or the other way round. Where it is less than "
         "`least` the light is as it was, and noise, shadows and reflections that pass are not followed.")
        .optional();
    d.out(state, "state", "For the next frame: wire it to before, delayed and by way of reproject.");
    d.out(frames, "frames",
          "Frames in which the step was not reached, so far: 0 where it was reached at once, and where none is "
          "followed.");
    d.out(lagging, "lagging", "1 where a step is followed and is not reached yet, else 0; between where pixels mix.");
    d.out(stepped, "stepped", "1 where a step is followed, else 0.");
    d.out(over, "over", "1 where the window ends with this frame, else 0: what frames says is final.");
    d.param(tolerance, "tolerance", "A step is reached where |error| is less than this share of it.").range(0, 1);
    d.param(least, "least", "Least share of stepping pixels that makes a step of the frame.").range(0, 1);
    d.param(window, "window", "Frames for which a step is followed, its own included. A further step begins anew.")
        .range(1, 10000);
  }

  void shapes(const quell_spec& spec, quell_shape* out) const {
    const auto& s = spec.in[step.index];
    out[state.index] = {s.width, s.height, kStates};
    for (const auto port : {frames.index, lagging.index, stepped.index, over.index}) out[port] = {s.width, s.height, 1};
    // Last: the state's shape is what the loop's other nodes learn theirs from.
    if (const int channels = spec.in[before.index].channels; channels < kStates)
      throw std::runtime_error("before has " + std::to_string(channels) + " channels, but the state of light_lag has " +
                               std::to_string(int(kStates)) + ": wire its own state, delayed, by way of reproject");
  }

  void run(const quell::Tile& tile) const {
    const bool steps = !tile.has(share) || std::abs(*tile.row(share, 0, 0)) >= least;
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float *now = tile.row(step, 0, y), *off = tile.row(error, 0, y);
      for (int x = tile.x0; x < tile.x1; ++x) {
        Pixel p;
        if (steps && now[x] != 0)
          p = {1, now[x], 0, 0, 1};
        else
          p = carried(tile, x, y);
        if (p.follows > 0) advance(p, off[x]);
        tile.row(state, kFollows, y)[x] = float(p.follows);
        tile.row(state, kStep, y)[x] = float(p.follows * p.step);
        tile.row(state, kAge, y)[x] = float(p.follows * p.age);
        tile.row(state, kFrames, y)[x] = float(p.follows * p.frames);
        tile.row(state, kLagging, y)[x] = float(p.follows * p.lagging);
        // A pixel belongs to what most of it shows.
        const bool counts = p.follows >= 0.5;
        tile.row(frames, 0, y)[x] = counts ? float(p.frames) : 0.0f;
        tile.row(lagging, 0, y)[x] = counts ? float(p.lagging) : 0.0f;
        tile.row(stepped, 0, y)[x] = counts ? 1.0f : 0.0f;
        tile.row(over, 0, y)[x] = counts && p.age > window - 0.5 ? 1.0f : 0.0f;
      }
    }
  }

 private:
  struct Pixel {
    double follows = 0, step = 0, age = 0, frames = 0, lagging = 0;
  };

  Pixel carried(const quell::Tile& tile, int x, int y) const {
    const auto was = [&](int channel) { return double(tile.row(before, channel, y)[x]); };
    const double follows = was(kFollows);
    if (!(follows >= kLeast)) return {};
    Pixel p{follows, was(kStep) / follows, was(kAge) / follows, was(kFrames) / follows, was(kLagging) / follows};
    // Ages mix where two steps meet, so the end lies half a frame before the next one.
    if (p.age > window - 0.5) return {};
    return p;
  }

  void advance(Pixel& p, double off) const {
    const bool wrong = std::abs(off) >= double(tolerance) * std::abs(p.step);
    p.lagging = wrong ? p.lagging : 0;
    p.frames += p.lagging;
    p.age += 1;
  }
};

}  // namespace
QUELL_PLUGIN("light_lag", LightLag)
