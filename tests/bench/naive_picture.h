// Images as plain loops hold them: all of a pixel together.
#pragma once

#include <quell/abi.h>

#include <cstddef>
#include <vector>

namespace quell::bench {

struct Rgb {
  float r = 0, g = 0, b = 0;
};
inline Rgb operator+(Rgb a, Rgb b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
inline Rgb operator-(Rgb a, Rgb b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
inline Rgb operator*(Rgb a, Rgb b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
inline Rgb operator/(Rgb a, Rgb b) { return {a.r / b.r, a.g / b.g, a.b / b.b}; }
inline Rgb operator*(float k, Rgb a) { return {k * a.r, k * a.g, k * a.b}; }
inline float dot(Rgb a, Rgb b) { return a.r * b.r + a.g * b.g + a.b * b.b; }
inline float luminance(Rgb c) { return dot(c, {0.2126f, 0.7152f, 0.0722f}); }
inline bool is_zero(Rgb c) { return c.r == 0 && c.g == 0 && c.b == 0; }

struct Pair {
  float x = 0, y = 0;
};

template <class T>
class Picture {
 public:
  Picture() = default;
  Picture(int width, int height) : width_(width), height_(height), pixels_(std::size_t(width) * std::size_t(height)) {}
  T& operator()(int x, int y) { return pixels_[std::size_t(y) * std::size_t(width_) + std::size_t(x)]; }
  const T& operator()(int x, int y) const { return pixels_[std::size_t(y) * std::size_t(width_) + std::size_t(x)]; }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  bool empty() const { return pixels_.empty(); }

 private:
  int width_ = 0, height_ = 0;
  std::vector<T> pixels_;
};

template <class T, class Get>
Picture<T> picture(const quell_image& image, Get get) {
  Picture<T> out(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) out(x, y) = get([&](int c) { return image.plane[c][y * image.pitch + x]; });
  return out;
}
inline Picture<Rgb> colors(const quell_image& image) {
  return picture<Rgb>(image, [](auto at) { return Rgb{at(0), at(1), at(2)}; });
}

}  // namespace quell::bench
