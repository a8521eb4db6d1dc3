// Decides which pixels of the previous frame show the same surface as a pixel now: the gate of every temporal node.
#include <quell/node.h>

#include <algorithm>
#include <stdexcept>

#include "disocclusion/disocclusion_kernels.h"
#include "disocclusion/taps.h"

namespace {

struct Disocclusion {
  quell::In<quell::Motion> motion;
  quell::In<quell::Slope> slope;
  quell::In<quell::Depth> depth, depth_before;
  quell::In<quell::Normal> normal, normal_before;
  quell::In<quell::Id> id, id_before;
  quell::In<quell::Position> position, position_before;
  quell::Out<quell::Taps> taps;
  quell::TapMode mode = quell::TapMode::bilinear;
  bool fallback = true;
  float depth_tolerance = 10.0f;
  float depth_floor = 0.01f;
  float normal_cosine = 0.9f;
  float plane_tolerance = 0.01f;

  void describe(quell::Describe& d) {
    d.summary(
        "Tests which pixels of the previous frame show the surface that a pixel shows now, by whichever guides are "
        "wired.");
    d.source(
        "Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, section 4.1. Tolerances after Falcor's SVGF "
        "pass; of the plane after ReBLUR (NVIDIA Real-Time Denoisers 4). GAMES202 homework 5: mode nearest, id alone, "
        "no fallback.");
    d.in(motion, "motion", "Pixels, previous − current. A position outside the image is disoccluded.");
    d.in(slope, "slope", "Slope of depth now; without it, 0.").optional();
    d.in(depth, "depth", "Depth now.").optional();
    d.in(depth_before, "depth_before",
         "Depth one frame earlier, as seen by that frame's camera. It is compared with depth as it is, so "
         "depth_tolerance must cover how far the camera moves along its axis within a frame.")
        .optional()
        .anywhere();
    d.in(normal, "normal", "Normal now; (0,0,0) is a miss, which agrees with misses alone.").optional();
    d.in(normal_before, "normal_before", "Normal one frame earlier.").optional().anywhere();
    d.in(id, "id", "Object now.").optional();
    d.in(id_before, "id_before", "Object one frame earlier.").optional().anywhere();
    d.in(position, "position",
         "World-space position now, for the plane test, which also wants normal and depth. Positions are compared as "
         "they are: a surface that moves along its normal by more than the tolerance is taken for another.")
        .optional();
    d.in(position_before, "position_before", "World-space position one frame earlier.").optional().anywhere();
    d.out(taps, "taps",
          "Bilinear weights of the valid ones of four taps, scaled to sum 1, all 0 where they hold less than 0.01; and "
          "the mask of valid pixels around them. All 0 where history is missing.");
    d.param(mode, "mode",
            "bilinear: four taps, each tested. nearest: the pixel that holds the previous position, with weight 1.",
            {"bilinear", "nearest"});
    d.param(fallback, "fallback",
            "Leave valid pixels of the 3×3 in the mask where no tap is valid, so that their mean is taken. If not, the "
            "mask is 0 there and the pixel starts anew.");
    d.param(depth_tolerance, "depth_tolerance",
            "Depths agree within depth_tolerance times |slope x| + |slope y| + depth_floor·depth.")
        .range(0, 1e6);
    d.param(depth_floor, "depth_floor", "Share of the depth that counts as slope, for surfaces that face the camera.")
        .range(0, 1);
    d.param(normal_cosine, "normal_cosine", "Least cosine between normals that agree.").range(-1, 1);
    d.param(plane_tolerance, "plane_tolerance",
            "Positions agree within plane_tolerance, a share of the depth, of the plane that the surface lies in now.")
        .range(0, 1e6);
  }

  void shapes(const quell_spec& spec, quell_shape*) const {
    const auto pair = [&](int now, int then, const char* text) {
      if ((spec.in_count[now] > 0) != (spec.in_count[then] > 0)) throw std::runtime_error(text);
    };
    pair(depth.index, depth_before.index, "depth and depth_before go together: one is connected and the other is not");
    pair(normal.index, normal_before.index,
         "normal and normal_before go together: one is connected and the other is not");
    pair(id.index, id_before.index, "id and id_before go together: one is connected and the other is not");
    pair(position.index, position_before.index,
         "position and position_before go together: one is connected and the other is not");
    if (spec.in_count[position.index] && !(spec.in_count[depth.index] && spec.in_count[normal.index]))
      throw std::runtime_error(
          "position is tested against the plane of the surface, which takes normal and depth: connect both, or leave "
          "position unconnected");
  }

  void run(const quell::Tile& tile) const {
    if (tile.missing(depth_before) || tile.missing(normal_before) || tile.missing(id_before) ||
        tile.missing(position_before))
      return clear(tile);
    const quell::TapRules rules{mode, fallback, depth_tolerance, depth_floor, normal_cosine, plane_tolerance};
    for (int y = tile.y0; y < tile.y1; ++y) {
      float* const weight[4] = {tile.row(taps, 0, y), tile.row(taps, 1, y), tile.row(taps, 2, y), tile.row(taps, 3, y)};
      quell::validate_taps(guides(tile, y), rules, y, tile.x0, tile.x1, weight, tile.bits(taps, quell::kTapsMask, y));
    }
  }

 private:
  void clear(const quell::Tile& tile) const {
    for (int plane = 0; plane < 5; ++plane)
      for (int y = tile.y0; y < tile.y1; ++y)
        std::fill(tile.row(taps, plane, y) + tile.x0, tile.row(taps, plane, y) + tile.x1, 0.0f);
  }

  quell::TapGuides guides(const quell::Tile& tile, int y) const {
    const auto& image = tile[motion];
    quell::TapGuides g{};
    g.width = image.width, g.height = image.height, g.pitch = image.pitch;
    for (int c = 0; c < 2; ++c) {
      g.motion[c] = tile.row(motion, c, y);
      if (tile.has(slope)) g.slope[c] = tile.row(slope, c, y);
    }
    if (tile.has(depth)) g.depth = tile.row(depth, 0, y), g.depth_before = tile.row(depth_before, 0, 0);
    if (tile.has(id)) g.id = tile.bits(id, 0, y), g.id_before = tile.bits(id_before, 0, 0);
    for (int c = 0; c < 3 && tile.has(normal); ++c)
      g.normal[c] = tile.row(normal, c, y), g.normal_before[c] = tile.row(normal_before, c, 0);
    for (int c = 0; c < 3 && tile.has(position); ++c)
      g.position[c] = tile.row(position, c, y), g.position_before[c] = tile.row(position_before, c, 0);
    return g;
  }
};

}  // namespace
QUELL_PLUGIN("disocclusion", Disocclusion)
