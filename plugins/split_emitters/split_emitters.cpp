// Sets aside the light that must enter no kernel, so that lamps neither spread over what they light nor are filtered.
#include <quell/node.h>

#include <cstdint>

#include "split_emitters/split_emitters_kernels.h"

namespace {

enum class Mode : std::int32_t { pass, keep };

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
        "guides that come out these pixels are misses, so no weight node lets them meet a surface.");
    d.source(
        "Our own. Measured on a Cycles Cornell room at 1 spp: a lamp filtered with its surroundings costs 6 dB in "
        "frame 4.");
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
    for (int y = tile.y0; y < tile.y1; ++y) {
      quell::SplitRow r{};
      r.keep = mode == Mode::keep;
      for (int c = 0; c < 3; ++c) {
        r.color[c] = tile.row(image, c, y), r.lit[c] = tile.row(lit, c, y), r.aside[c] = tile.row(aside, c, y);
        if (tile.has(albedo)) r.albedo[c] = tile.row(albedo, c, y);
        if (tile.has(emission)) r.emission[c] = tile.row(emission, c, y);
        if (tile.has(normal)) r.normal[c] = tile.row(normal, c, y), r.normal_out[c] = tile.row(normal_out, c, y);
      }
      if (tile.has(depth)) r.depth = tile.row(depth, 0, y), r.depth_out = tile.row(depth_out, 0, y);
      quell::split_emitters(r, tile.x0, tile.x1);
    }
  }
};

}  // namespace
QUELL_PLUGIN("split_emitters", SplitEmitters)
