// Runs an OpenColorIO processor over a tile of planar images.
#include "color_transform/pixels.h"

#include <algorithm>

namespace quell::color {

namespace {

ocio::PlanarImageDesc tile_of(const quell_image& image, const quell_tile& t) {
  const auto plane = [&](int c) { return image.plane[c] + t.y0 * image.pitch + t.x0; };
  return {plane(0),
          plane(1),
          plane(2),
          nullptr,
          t.x1 - t.x0,
          t.y1 - t.y0,
          ocio::BIT_DEPTH_F32,
          ptrdiff_t(sizeof(float)),
          ptrdiff_t(sizeof(float)) * image.pitch};
}

}  // namespace

// Lossless: the default takes powers by an estimate that is good to some 1e-4, and is no faster for most transforms.
Pixels::Pixels(const ocio::ConstProcessorRcPtr& processor)
    : processor_(processor->getOptimizedCPUProcessor(ocio::OPTIMIZATION_LOSSLESS)) {}

void Pixels::run(const quell_tile& tile, const quell_image& in, const quell_image& out, float most) const {
  const auto from = tile_of(in, tile);
  auto to = tile_of(out, tile);
  processor_->apply(from, to);
  for (int c = 0; c < 3; ++c)
    for (int y = tile.y0; y < tile.y1; ++y) {
      float* const row = out.plane[c] + y * out.pitch;
      for (int x = tile.x0; x < tile.x1; ++x) row[x] = row[x] > 0 ? std::min(row[x], most) : 0.0f;
    }
}

}  // namespace quell::color
