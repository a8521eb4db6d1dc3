// Owned planar images, laid out as the plugin boundary promises: rows aligned to 64 bytes, one pitch for each width,
// and a readable margin around every plane.
#pragma once

#include <quell/abi.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace quell {

// Floats from a row to the next, for images of this width: a multiple of 16 that is no multiple of 1024, so that rows
// do not compete for the same cache sets.
std::ptrdiff_t pitch_for(int width);
// Floats that one plane takes, margins included; a multiple of 16.
std::size_t plane_floats(int width, int height);

// Points planes into `memory` (channels × plane_floats, aligned to 64 bytes).
void lay_out(float* memory, const quell_shape&, std::vector<float*>& planes);

class Image {
 public:
  Image() = default;
  Image(int width, int height, int channels);
  explicit Image(const quell_shape& s) : Image(s.width, s.height, s.channels) {}
  Image(Image&&) noexcept = default;
  Image& operator=(Image&&) noexcept = default;

  int width() const { return shape_.width; }
  int height() const { return shape_.height; }
  int channels() const { return shape_.channels; }
  std::ptrdiff_t pitch() const { return pitch_; }
  quell_shape shape() const { return shape_; }
  float* row(int channel, int y) { return planes_[std::size_t(channel)] + y * pitch_; }
  const float* row(int channel, int y) const { return planes_[std::size_t(channel)] + y * pitch_; }
  std::uint32_t* bits(int channel, int y) { return reinterpret_cast<std::uint32_t*>(row(channel, y)); }
  const std::uint32_t* bits(int channel, int y) const {
    return reinterpret_cast<const std::uint32_t*>(row(channel, y));
  }
  float& at(int channel, int x, int y) { return row(channel, y)[x]; }
  float at(int channel, int x, int y) const { return row(channel, y)[x]; }
  void fill(float value);
  Image copy() const;
  bool empty() const { return planes_.empty(); }
  // As it crosses the plugin boundary; valid while this image lives where it is.
  quell_image view() const { return {planes_.data(), shape_.width, shape_.height, shape_.channels, 0, pitch_}; }

 private:
  struct Free {
    void operator()(float* p) const;
  };
  quell_shape shape_{};
  std::ptrdiff_t pitch_ = 0;
  std::unique_ptr<float, Free> memory_;
  std::vector<float*> planes_;
};

// Fills an image with what its type reads as when history is missing.
void fill_missing(const quell_image&, int type);

}  // namespace quell
