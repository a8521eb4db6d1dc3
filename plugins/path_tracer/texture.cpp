// Patterns computed from the place on a surface, so that they are sharp at every size.
#include "path_tracer/sampler.h"
#include "path_tracer/scene.h"

namespace path_tracer {

namespace {

double lattice(std::int64_t x, std::int64_t y) { return mixed(mixed(std::uint32_t(x)), std::uint32_t(y)) * 0x1p-32; }

// Value noise in [0, 1) with quintic interpolation.
double bumps(const glm::dvec2& p) {
  const glm::dvec2 floor = glm::floor(p), f = p - floor;
  const glm::dvec2 w = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  const auto x = std::int64_t(floor.x), y = std::int64_t(floor.y);
  const double north = lattice(x, y) + (lattice(x + 1, y) - lattice(x, y)) * w.x;
  const double south = lattice(x, y + 1) + (lattice(x + 1, y + 1) - lattice(x, y + 1)) * w.x;
  return north + (south - north) * w.y;
}

}  // namespace

Rgb Texture::at(const glm::dvec2& surface) const {
  switch (pattern) {
    case Pattern::constant:
      return a;
    case Pattern::checker: {
      const glm::dvec2 cell = glm::floor(surface / size);
      return std::fmod(std::abs(cell.x + cell.y), 2.0) < 0.5 ? a : b;
    }
    case Pattern::stripes: {
      const double along = (surface.x * std::cos(angle) + surface.y * std::sin(angle)) / size;
      return along - std::floor(along) < 0.5 ? a : b;
    }
    case Pattern::noise: {
      double sum = 0, weight = 0, amplitude = 1, scale = 1 / size;
      for (int i = 0; i < octaves; ++i, amplitude *= 0.5, scale *= 2) {
        sum += amplitude * bumps(surface * scale + 17.0 * i);
        weight += amplitude;
      }
      return a + (b - a) * float(sum / weight);
    }
  }
  return a;
}

}  // namespace path_tracer
