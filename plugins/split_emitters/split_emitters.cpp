// Sets aside the light that must enter no kernel, so that lamps neither spread over what they light nor are filtered.
#include <quell/node.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace {

// Cycles writes an emitter's radiance into its albedo pass, so there the two are equal but for the rounding of the
// file.
constexpr float kSame = 1e-3f;

enum class Mode : std::int32_t { pass, keep };

struct Pixel {
  float color[3];
  float albedo[3];
  float emission[3];
};

bool emits(const Pixel& p, bool has_emission) {
  if (has_emission) return p.emission[0] > 0 || p.emission[1] > 0 || p.emission[2] > 0;
  const float brightest = std::max({p.albedo[0], p.albedo[1], p.albedo[2]});
  if (!(brightest > 1)) return false;
  for (int c = 0; c < 3; ++c)
    if (!(std::abs(p.color[c] - p.albedo[c]) <= kSame * brightest)) return false;
  return true;
}

struct SplitEmitters {
  quell::In<quell::Radiance> image;
  quell::In<quell::Albedo> albedo;
  quell::In<quell::Radiance> emission;
  quell::In<quell::Normal> normal;
  quell::In<quell::Depth> depth;
  quell::Out<quell::Radiance> lit;
  quell::Out<quell::Radiance> aside;
  quell::Out<quell::Normal> normal_out;
  quell::Out<quell::Depth> depth_out;
  Mode mode = Mode::pass;

  void describe(quell::Describe& d) {
    d.summary(
        "Sets aside the light that must enter no kernel: emitters and misses whole. `modulate` adds it back; in the "
        "guides "
        "that come out these pixels are misses, so no weight node lets them meet a surface.");
    d.source(
        "Measured: filtering a lamp with its surroundings costs 6 dB in the first frames (Cycles Cornell room, 1 "
        "spp).");
    d.in(image, "image", "Noisy radiance.");
    d.in(albedo, "albedo",
         "Tells emitters where no emission is given: a channel above 1, and the radiance equal to the albedo within "
         "0.1 %.")
        .optional();
    d.in(emission, "emission", "Radiance that the surface itself emits; a pixel with any is an emitter.").optional();
    d.in(normal, "normal", "World-space normal; (0,0,0) is a miss.").optional();
    d.in(depth, "depth", "Depth; 1e30 is a miss.").optional();
    d.out(lit, "image", "Radiance that surfaces reflect; 0 where the pixel is set aside.").passes(image);
    d.out(aside, "emission", "The rest: image + emission is the input image.");
    d.out(normal_out, "normal", "The normal, (0,0,0) where the pixel is set aside.").with(normal).passes(normal);
    d.out(depth_out, "depth", "The depth, 1e30 where the pixel is set aside.").with(depth).passes(depth);
    d.param(mode, "mode",
            "pass: emitters and misses are set aside whole. keep: they stay in the image, and only a given emission is "
            "subtracted from it.",
            {"pass", "keep"});
  }

  void run(const quell::Tile& tile) const {
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) run_pixel(tile, x, y);
  }

  void run_pixel(const quell::Tile& tile, int x, int y) const {
    const bool has_emission = tile.has(emission), has_albedo = tile.has(albedo);
    const bool has_normal = tile.has(normal), has_depth = tile.has(depth);
    Pixel p{};
    float n[3] = {};
    for (int c = 0; c < 3; ++c) {
      p.color[c] = tile.row(image, c, y)[x];
      if (has_albedo) p.albedo[c] = tile.row(albedo, c, y)[x];
      if (has_emission) p.emission[c] = tile.row(emission, c, y)[x];
      if (has_normal) n[c] = tile.row(normal, c, y)[x];
    }
    const float z = has_depth ? tile.row(depth, 0, y)[x] : 0;
    const bool miss = (has_normal && n[0] == 0 && n[1] == 0 && n[2] == 0) || z >= 0.5f * quell::kFar;
    const bool apart = mode == Mode::pass && (miss || emits(p, has_emission));
    for (int c = 0; c < 3; ++c) {
      // What is below zero after the subtraction goes with the emission, so that the sum stays exact.
      const float rest = apart ? 0 : has_emission ? std::max(p.color[c] - p.emission[c], 0.0f) : p.color[c];
      tile.row(lit, c, y)[x] = rest;
      tile.row(aside, c, y)[x] = p.color[c] - rest;
      if (has_normal) tile.row(normal_out, c, y)[x] = apart ? 0 : n[c];
    }
    if (has_depth) tile.row(depth_out, 0, y)[x] = apart ? quell::kFar : z;
  }
};

}  // namespace
QUELL_PLUGIN("split_emitters", SplitEmitters)
