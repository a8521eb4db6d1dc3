// Guarded outputs and their comparison.
#include "tests/contract/guarded.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace quell::test {

namespace {

constexpr std::size_t kAlign = 16;  // floats: 64 bytes

bool is_integer(int type, int channel) {
  const auto* info = type_info(type);
  return (info && info->integer) || (type == QUELL_TAPS && channel == 4);
}

}  // namespace

Guarded::Guarded(const quell_shape& shape) : shape_(shape), pitch_(pitch_for(shape.width)) {
  memory_.resize(plane_floats(shape.width, shape.height) * std::size_t(shape.channels) + kAlign);
  reset();
  const auto address = reinterpret_cast<std::uintptr_t>(memory_.data());
  const std::size_t skip = (64 - address % 64) % 64 / sizeof(float);
  lay_out(reinterpret_cast<float*>(memory_.data() + skip), shape_, planes_);
}

quell_image Guarded::view() const { return {planes_.data(), shape_.width, shape_.height, shape_.channels, 0, pitch_}; }

float Guarded::at(int channel, int x, int y) const { return planes_[std::size_t(channel)][y * pitch_ + x]; }
std::uint32_t Guarded::bits(int channel, int x, int y) const { return std::bit_cast<std::uint32_t>(at(channel, x, y)); }
void Guarded::reset() { std::ranges::fill(memory_, kUntouched); }

std::string Guarded::misplaced(const Rect& tile, bool whole) const {
  const Rect r = whole ? Rect{0, 0, shape_.width, shape_.height} : tile;
  const int slack = r.x1 == shape_.width ? (r.x1 + 15) / 16 * 16 : r.x1;
  for (int c = 0; c < shape_.channels; ++c) {
    const float* plane = planes_[std::size_t(c)];
    const std::ptrdiff_t end = std::ptrdiff_t(plane_floats(shape_.width, shape_.height)) - QUELL_MARGIN;
    for (std::ptrdiff_t i = -QUELL_MARGIN; i < end; ++i) {
      const auto y = int(i >= 0 ? i / pitch_ : -1), x = int(i - y * pitch_);
      const bool touched = std::bit_cast<std::uint32_t>(plane[i]) != kUntouched;
      if (r.holds(x, y) && !touched) return fmt::format("pixel ({}, {}) of channel {} is not written", x, y, c);
      if (y >= r.y0 && y < r.y1 && x >= r.x0 && x < slack) continue;
      if (touched) return fmt::format("channel {} is written at ({}, {}), outside the tile", c, x, y);
    }
  }
  return "";
}

Outputs::Outputs(const Use& use, const Bound& bound) {
  for (std::size_t o = 0; o < use.type->outputs().size(); ++o) {
    const int type = use.out_type(int(o));
    images.push_back(bound.exists(int(o)) ? std::make_unique<Guarded>(bound.shapes()[o]) : nullptr);
    types.push_back(type);
    pixels.push_back(is_pixels(type));
    names.emplace_back(use.type->outputs()[o].name);
  }
}

std::vector<quell_image> Outputs::views() const {
  std::vector<quell_image> views;
  for (const auto& image : images) views.push_back(image ? image->view() : quell_image{});
  return views;
}

void Outputs::reset() {
  for (const auto& image : images)
    if (image) image->reset();
}

std::string difference(const Outputs& a, const Outputs& b, const Rect& where) {
  for (std::size_t o = 0; o < a.images.size(); ++o) {
    if (!a.images[o] || (!a.pixels[o] && !where.holds(0, 0))) continue;
    const auto& s = a.images[o]->shape();
    const Rect r = a.pixels[o] ? where : Rect{0, 0, s.width, s.height};
    for (int c = 0; c < s.channels; ++c)
      for (int y = r.y0; y < r.y1; ++y)
        for (int x = r.x0; x < r.x1; ++x)
          if (a.images[o]->bits(c, x, y) != b.images[o]->bits(c, x, y))
            return fmt::format("{}: channel {} at ({}, {}) is {:.9g} ({:#010x}), not {:.9g} ({:#010x})", a.names[o], c,
                               x, y, b.images[o]->at(c, x, y), b.images[o]->bits(c, x, y), a.images[o]->at(c, x, y),
                               a.images[o]->bits(c, x, y));
  }
  return "";
}

std::string not_finite(const Outputs& out) {
  for (std::size_t o = 0; o < out.images.size(); ++o) {
    if (!out.images[o]) continue;
    const auto& s = out.images[o]->shape();
    for (int c = 0; c < s.channels; ++c) {
      if (is_integer(out.types[o], c)) continue;
      for (int y = 0; y < s.height; ++y)
        for (int x = 0; x < s.width; ++x)
          if (!std::isfinite(out.images[o]->at(c, x, y)))
            return fmt::format("{}: channel {} at ({}, {}) is {}", out.names[o], c, x, y, out.images[o]->at(c, x, y));
    }
  }
  return "";
}

}  // namespace quell::test
