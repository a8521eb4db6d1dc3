// Planes for the hand-fused opponents.
#pragma once

#include "core/image/image.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace quell::bench {

// Planes of one size with a border of zeros that taps may fall into.
class Padded {
 public:
  static constexpr int kBorder = 64;
  Padded(int width, int height, int planes) : height_(height), pitch_(pitch_for(width + 2 * kBorder)) {
    for (int i = 0; i < planes; ++i)
      planes_.emplace_back(std::size_t(pitch_) * std::size_t(height + 2 * kBorder) + 64, 0.0f);
  }
  std::ptrdiff_t pitch() const { return pitch_; }
  float* row(int plane, int y) { return planes_[std::size_t(plane)].data() + (y + kBorder) * pitch_ + kBorder; }
  const float* row(int plane, int y) const { return const_cast<Padded*>(this)->row(plane, y); }
  void take(int first, const quell_image& image) {
    for (int c = 0; c < image.channels; ++c)
      for (int y = 0; y < height_; ++y) std::copy_n(image.plane[c] + y * image.pitch, image.width, row(first + c, y));
  }

 private:
  int height_;
  std::ptrdiff_t pitch_;
  std::vector<std::vector<float>> planes_;
};

}  // namespace quell::bench
