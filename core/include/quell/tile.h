// What a node's code touches: ports, parameter types and the tile that run is to fill.
#pragma once

#include <quell/abi.h>
#include <quell/types.h>

#include <bit>
#include <cstdint>
#include <span>
#include <string_view>

namespace quell {

template <class T>
struct In {
  using Type = T;
  std::int32_t index = -1;
};
template <class T>
struct InList {
  using Type = T;
  std::int32_t index = -1;
};
template <class T>
struct Out {
  using Type = T;
  std::int32_t index = -1;
};

// Text and Path parameters: the host owns the bytes.
struct Text {
  quell_text raw{"", 0};
  operator std::string_view() const { return {raw.data, raw.size}; }
  const char* c_str() const { return raw.data; }
  bool empty() const { return raw.size == 0; }
};
struct Path : Text {};
// A parameter of N numbers.
template <int N>
struct Vec {
  float v[N];
  float operator[](int i) const { return v[i]; }
};

// A rectangle of the outputs, and the inputs in full. Rows are pointers to pixel x = 0.
struct Tile : quell_tile {
  template <class T>
  const quell_image& operator[](In<T> p) const {
    return in[p.index].image[0];
  }
  template <class T>
  const quell_image& operator[](Out<T> p) const {
    return out[p.index];
  }
  template <class T>
  std::span<const quell_image> operator[](InList<T> p) const {
    return {in[p.index].image, std::size_t(in[p.index].count)};
  }
  std::span<const quell_bound_weight> operator[](InList<Weight> p) const {
    return {in[p.index].weight, std::size_t(in[p.index].count)};
  }
  template <class T>
  bool has(In<T> p) const {
    return in[p.index].count > 0;
  }
  template <class T>
  bool has(Out<T> p) const {
    return out[p.index].plane != nullptr;
  }
  // A delayed wire that has no past this frame: it reads as the type's missing value.
  template <class T>
  bool missing(In<T> p) const {
    return in[p.index].count > 0 && in[p.index].image[0].missing != 0;
  }
  template <class T>
  const float* row(In<T> p, int channel, int y) const {
    const auto& i = (*this)[p];
    return i.plane[channel] + y * i.pitch;
  }
  template <class T>
  float* row(Out<T> p, int channel, int y) const {
    const auto& o = (*this)[p];
    return o.plane[channel] + y * o.pitch;
  }
  // Rows of integers: `id` images and the mask plane of `taps`.
  template <class T>
  const std::uint32_t* bits(In<T> p, int channel, int y) const {
    return reinterpret_cast<const std::uint32_t*>(row(p, channel, y));
  }
  template <class T>
  std::uint32_t* bits(Out<T> p, int channel, int y) const {
    return reinterpret_cast<std::uint32_t*>(row(p, channel, y));
  }
};

// The same for `weigh`, which has no tile.
template <class T>
bool has(const quell_input* in, In<T> p) {
  return in[p.index].count > 0;
}
template <class T>
const float* plane(const quell_input* in, In<T> p, int channel) {
  return in[p.index].image[0].plane[channel];
}

}  // namespace quell
