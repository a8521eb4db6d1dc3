// Decides which pixels of the previous frame show the same surface as a pixel now: the gate of every temporal node.
#include <quell/node.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "disocclusion/footprint.h"

namespace {

// Valid taps that hold less of the bilinear weight than this say too little (Falcor's SVGF uses the same number).
constexpr float kLeast = 0.01f;

enum class Mode : std::int32_t { bilinear, nearest };

// The surface that one pixel shows.
struct Surface {
  float depth, normal[3];
  std::uint32_t id;
};

bool miss(float depth) { return depth >= 0.5f * quell::kFar; }
bool miss(const float n[3]) { return n[0] == 0 && n[1] == 0 && n[2] == 0; }

struct Disocclusion {
  quell::In<quell::Motion> motion;
  quell::In<quell::Slope> slope;
  quell::In<quell::Depth> depth, depth_before;
  quell::In<quell::Normal> normal, normal_before;
  quell::In<quell::Id> id, id_before;
  quell::Out<quell::Taps> taps;
  Mode mode = Mode::bilinear;
  bool fallback = true;
  float depth_tolerance = 10.0f;
  float depth_floor = 0.01f;
  float normal_cosine = 0.9f;

  void describe(quell::Describe& d) {
    d.summary(
        "Tests which pixels of the previous frame show the surface that a pixel shows now, by whichever guides are "
        "wired.");
    d.source(
        "Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, section 4.1. Tolerances after Falcor's SVGF "
        "pass. "
        "GAMES202 homework 5: mode nearest, id alone, no fallback.");
    d.in(motion, "motion", "Pixels, previous − current. A position outside the image is disoccluded.");
    d.in(slope, "slope", "Slope of depth now; without it, 0.").optional();
    d.in(depth, "depth", "Depth now.").optional();
    d.in(depth_before, "depth_before",
         "Depth one frame earlier, as seen by that frame's camera. It is compared with depth as it is, so "
         "depth_tolerance must "
         "cover how far the camera moves along its axis within a frame.")
        .optional()
        .anywhere();
    d.in(normal, "normal", "Normal now; (0,0,0) is a miss, which agrees with misses alone.").optional();
    d.in(normal_before, "normal_before", "Normal one frame earlier.").optional().anywhere();
    d.in(id, "id", "Object now.").optional();
    d.in(id_before, "id_before", "Object one frame earlier.").optional().anywhere();
    d.out(taps, "taps",
          "Bilinear weights of the valid ones of four taps, scaled to sum 1, all 0 where they hold less than 0.01; and "
          "the mask "
          "of valid pixels around them. All 0 where history is missing.");
    d.param(mode, "mode",
            "bilinear: four taps, each tested. nearest: the pixel that holds the previous position, with weight 1.",
            {"bilinear", "nearest"});
    d.param(fallback, "fallback",
            "Leave valid pixels of the 3×3 in the mask where no tap is valid, so that their mean is taken. If not, the "
            "mask is 0 "
            "there and the pixel starts anew.");
    d.param(depth_tolerance, "depth_tolerance",
            "Depths agree within depth_tolerance·(|slope x| + |slope y| + depth_floor·depth).")
        .range(0, 1e6);
    d.param(depth_floor, "depth_floor", "Share of the depth that counts as slope, for surfaces that face the camera.")
        .range(0, 1);
    d.param(normal_cosine, "normal_cosine", "Least cosine between normals that agree.").range(-1, 1);
  }

  void shapes(const quell_spec& spec, quell_shape*) const {
    const auto pair = [&](int now, int then, const char* text) {
      if ((spec.in_count[now] > 0) != (spec.in_count[then] > 0)) throw std::runtime_error(text);
    };
    pair(depth.index, depth_before.index, "depth and depth_before go together: one is connected and the other is not");
    pair(normal.index, normal_before.index,
         "normal and normal_before go together: one is connected and the other is not");
    pair(id.index, id_before.index, "id and id_before go together: one is connected and the other is not");
  }

  void run(const quell::Tile& tile) const {
    const bool missing = tile.missing(depth_before) || tile.missing(normal_before) || tile.missing(id_before);
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float* mx = tile.row(motion, 0, y);
      const float* my = tile.row(motion, 1, y);
      float* out[4] = {tile.row(taps, 0, y), tile.row(taps, 1, y), tile.row(taps, 2, y), tile.row(taps, 3, y)};
      std::uint32_t* mask = tile.bits(taps, quell::kTapMask, y);
      const auto& image = tile[motion];
      for (int x = tile.x0; x < tile.x1; ++x) {
        float weight[4] = {};
        mask[x] = 0;
        const auto f = quell::footprint(x, y, mx[x], my[x], image.width, image.height);
        if (f.inside && !missing) mask[x] = test_taps(tile, x, y, f, weight);
        for (int t = 0; t < 4; ++t) out[t][x] = weight[t];
      }
    }
  }

  // The weights of the four taps; returns the mask.
  std::uint32_t test_taps(const quell::Tile& tile, int x, int y, const quell::Footprint& f, float weight[4]) const {
    const std::uint32_t valid = footprint_bits(tile, x, y, f);
    const auto bit = [&](int px, int py) { return valid >> ((py - f.y + 1) * 4 + px - f.x + 1) & 1u; };
    std::uint32_t mask = valid == 0xFFFFu ? quell::kWhole : 0;
    for (int t = 0; t < 9; ++t) mask |= bit(f.nearest_x + t % 3 - 1, f.nearest_y + t / 3 - 1) << t;

    float sum = 0;
    for (int t = 0; t < 4; ++t) {
      const int px = f.x + (t & 1), py = f.y + (t >> 1);
      float w = (t & 1 ? f.fx : 1 - f.fx) * (t & 2 ? f.fy : 1 - f.fy);
      if (mode == Mode::nearest) w = px == f.nearest_x && py == f.nearest_y ? 1.0f : 0.0f;
      weight[t] = bit(px, py) ? w : 0;
      sum += weight[t];
    }
    const bool enough = sum >= kLeast;
    for (int t = 0; t < 4; ++t) weight[t] = enough ? weight[t] / sum : 0;
    return enough || fallback ? mask : 0;
  }

  // Which pixels of the 4x4 around the previous position show the surface of (x, y); row by row from bit 0.
  std::uint32_t footprint_bits(const quell::Tile& tile, int x, int y, const quell::Footprint& f) const {
    const bool by_depth = tile.has(depth), by_normal = tile.has(normal), by_id = tile.has(id);
    Surface s{};
    if (by_depth) s.depth = tile.row(depth, 0, y)[x];
    if (by_normal)
      for (int c = 0; c < 3; ++c) s.normal[c] = tile.row(normal, c, y)[x];
    if (by_id) s.id = tile.bits(id, 0, y)[x];
    float slopes = 0;
    if (tile.has(slope)) slopes = std::abs(tile.row(slope, 0, y)[x]) + std::abs(tile.row(slope, 1, y)[x]);
    const float tolerance = depth_tolerance * (slopes + depth_floor * s.depth);

    const auto& image = tile[motion];
    std::uint32_t valid = 0;
    for (int j = 0; j < 4; ++j) {
      const int py = f.y - 1 + j;
      if (py < 0 || py >= image.height) continue;
      for (int i = 0; i < 4; ++i) {
        const int px = f.x - 1 + i;
        if (px < 0 || px >= image.width) continue;
        if (by_id && tile.bits(id_before, 0, py)[px] != s.id) continue;
        if (by_depth && !depths_agree(s.depth, tile.row(depth_before, 0, py)[px], tolerance)) continue;
        if (by_normal) {
          const float n[3] = {tile.row(normal_before, 0, py)[px], tile.row(normal_before, 1, py)[px],
                              tile.row(normal_before, 2, py)[px]};
          if (!normals_agree(s.normal, n)) continue;
        }
        valid |= 1u << (4 * j + i);
      }
    }
    return valid;
  }

  static bool depths_agree(float now, float then, float tolerance) {
    if (miss(now) || miss(then)) return miss(now) && miss(then);
    return std::abs(now - then) <= tolerance;
  }
  bool normals_agree(const float now[3], const float then[3]) const {
    if (miss(now) || miss(then)) return miss(now) && miss(then);
    return now[0] * then[0] + now[1] * then[1] + now[2] * then[2] >= normal_cosine;
  }
};

}  // namespace
QUELL_PLUGIN("disocclusion", Disocclusion)
