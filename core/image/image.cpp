// Owned planar images.
#include "core/image/image.h"

#include <quell/types.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>

namespace quell {

std::ptrdiff_t pitch_for(int width) {
  const std::ptrdiff_t pitch = (std::ptrdiff_t(width) + 15) / 16 * 16;
  return pitch % 1024 == 0 ? pitch + 16 : pitch;
}

std::size_t plane_floats(int width, int height) {
  return std::size_t(pitch_for(width)) * std::size_t(height) + 2 * QUELL_MARGIN;
}

void lay_out(float* memory, const quell_shape& s, std::vector<float*>& planes) {
  planes.resize(std::size_t(s.channels));
  for (std::size_t c = 0; c < planes.size(); ++c)
    planes[c] = memory + c * plane_floats(s.width, s.height) + QUELL_MARGIN;
}

void Image::Free::operator()(float* p) const { std::free(p); }

Image::Image(int width, int height, int channels) : shape_{width, height, channels}, pitch_(pitch_for(width)) {
  const std::size_t bytes = plane_floats(width, height) * std::size_t(channels) * sizeof(float);
  memory_.reset(static_cast<float*>(std::aligned_alloc(64, bytes)));
  if (!memory_) throw std::bad_alloc();
  std::memset(memory_.get(), 0, bytes);
  lay_out(memory_.get(), shape_, planes_);
}

void Image::fill(float value) {
  for (int c = 0; c < channels(); ++c)
    for (int y = 0; y < height(); ++y) std::fill_n(row(c, y), width(), value);
}

Image Image::copy() const {
  Image other(shape_);
  std::memcpy(other.memory_.get(), memory_.get(),
              plane_floats(shape_.width, shape_.height) * std::size_t(shape_.channels) * sizeof(float));
  return other;
}

void fill_missing(const quell_image& image, int type) {
  const auto* info = type_info(type);
  for (int c = 0; c < image.channels; ++c)
    for (int y = 0; y < image.height; ++y) {
      float* row = image.plane[c] + y * image.pitch;
      if (info && info->storage == Storage::table)
        for (int x = 0; x < image.width; ++x) row[x] = x % 16 % 5 == 0 ? 1.0f : 0.0f;
      else if (info && info->integer)
        std::memset(row, 0xFF, std::size_t(image.width) * sizeof(float));
      else
        std::fill_n(row, image.width, info ? info->missing : 0.0f);
    }
}

}  // namespace quell
