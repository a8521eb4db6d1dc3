// Frames of a stage.
#include "tests/support/stage.h"

#include <quell/types.h>

#include <cmath>

namespace quell::test {

namespace {

// In (0, 1), a function of pixel and frame alone.
double dice(std::int64_t frame, int x, int y) {
  std::uint32_t h =
      std::uint32_t(x) * 0x9E3779B1u ^ std::uint32_t(y) * 0x85EBCA77u ^ std::uint32_t(frame) * 0xC2B2AE3Du;
  h = (h ^ h >> 15) * 0x2C1B3C6Du;
  h = (h ^ h >> 12) * 0x297A2D39u;
  h ^= h >> 15;
  return (double(h) + 0.5) * 0x1p-32;
}

double reflected(const StagePixel& p) { return p.albedo > 0 ? p.light * p.albedo : p.light; }

}  // namespace

Stage::Stage(int width, int height, int frames, Play play, std::int64_t cut)
    : width_(width), height_(height), cut_(cut), play_(std::move(play)) {
  for (int f = 0; f < frames; ++f) frames_.push_back(f);
  roles_ = {{"color", QUELL_RADIANCE},
            {"albedo", QUELL_ALBEDO},
            {"normal", QUELL_NORMAL},
            {"depth", QUELL_DEPTH},
            {"motion", QUELL_MOTION}};
}

float Stage::truth(std::int64_t frame, int x, int y) const { return float(reflected(play_(frame, x, y))); }

std::vector<quell_shape> Stage::shapes(std::int64_t, std::span<const std::string> roles) {
  std::vector<quell_shape> shapes;
  for (const auto& role : roles) shapes.push_back({width_, height_, type_info(roles_.at(role))->channels});
  return shapes;
}

void Stage::read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) {
  for (std::size_t i = 0; i < roles.size(); ++i)
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const auto p = play_(frame, x, y);
        // Light is exponentially distributed, as that of paths is that seldom find the lamp.
        const double light = reflected(p) * (1 + p.noise * (-std::log(dice(frame, x, y)) - 1));
        for (int c = 0; c < into[i].channels; ++c) {
          float value = 0;
          switch (roles_.at(roles[i])) {
            case QUELL_RADIANCE:
              value = float(light);
              break;
            case QUELL_ALBEDO:
              value = p.albedo;
              break;
            case QUELL_NORMAL:
              value = c == 2 ? -1.0f : 0.0f;
              break;
            case QUELL_DEPTH:
              value = p.depth;
              break;
            default:
              value = c == 0 ? p.dx : p.dy;
          }
          into[i].plane[c][y * into[i].pitch + x] = value;
        }
      }
}

}  // namespace quell::test
