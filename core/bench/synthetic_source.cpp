// Synthetic frames.
#include "core/bench/synthetic_source.h"

#include <quell/types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace quell {

namespace {

constexpr int kColumns = 8, kRows = 6, kObjects = kColumns * kRows, kFeatures = 8;

// A number in [0, 1) that is a function of pixel, channel and take alone.
float random(int x, int y, int channel, int take) {
  auto h =
      std::uint32_t(x) * 0x9E3779B1u ^ std::uint32_t(y) * 0x85EBCA77u ^ std::uint32_t(channel * 8 + take) * 0xC2B2AE3Du;
  h = (h ^ h >> 15) * 0x2C1B3C6Du;
  h = (h ^ h >> 12) * 0x297A2D39u;
  return float((h ^ h >> 15) >> 8) * 0x1p-24f;
}

// What a pixel shows: a patch is an object, a plane of its own slope and shade with a gentle bump; two are sky and one
// is a lamp.
struct Surface {
  int object;
  bool sky;
  float emitted;        // radiance
  float u, v;           // position in the image, 0 to 1
  float depth, dx, dy;  // depth and its slope per pixel
  std::array<float, 3> normal, albedo;
};

Surface surface(int x, int y, int width, int height) {
  Surface s;
  s.u = (float(x) + 0.5f) / float(width), s.v = (float(y) + 0.5f) / float(height);
  const int column = std::min(kColumns - 1, int(s.u * kColumns)), row = std::min(kRows - 1, int(s.v * kRows));
  s.object = row * kColumns + column;
  s.sky = s.object == 3 || s.object == 20;
  s.emitted = s.object == 29 ? 4.0f : 0.0f;
  s.dx = 0.4f * std::sin(1.7f * float(column)) / float(width),
  s.dy = 0.4f * std::cos(2.3f * float(row)) / float(height);
  s.depth = 5 + 0.25f * float(s.object % 7) + s.dx * float(x) + s.dy * float(y);
  const float a = 0.5f * std::sin(1.7f * float(column)) + 0.1f * std::sin(40 * s.u),
              b = 0.5f * std::cos(2.3f * float(row));
  const float scale = 1 / std::sqrt(a * a + b * b + 1);
  s.normal = {a * scale, b * scale, -scale};
  const float texture = 0.75f + 0.25f * std::sin(90 * s.u) * std::sin(70 * s.v);
  for (int c = 0; c < 3; ++c) s.albedo[std::size_t(c)] = texture * (0.3f + 0.08f * float((s.object + 3 * c) % 8));
  return s;
}

// Below a pixel, of another fraction everywhere; three objects move faster and uncover a strip beside them.
std::array<float, 2> motion(const Surface& s) {
  const float fast = s.object % 16 == 5 ? 4.0f : 0.0f;
  return {fast + 0.2f + 0.6f * std::sin(5 * s.u + 2 * s.v), -0.1f + 0.5f * std::cos(4 * s.v)};
}

// One path's estimate: dark or bright more often than right, now and then a firefly; its mean is about `mean`.
float one_sample(float mean, int x, int y, int take) {
  const float r = random(x, y, 7, take);
  if (r < 0.3f) return 0;
  return mean * (r > 0.998f ? 60.0f : -1.25f * std::log(1 - random(x, y, 6, take)));
}

// Those of `motion`, every pixel inside the image valid.
void fill_taps(Image& image, int x, int y, const Surface& s) {
  const auto [mx, my] = motion(s);
  const float px = float(x) + 0.5f + mx, py = float(y) + 0.5f + my;
  const int cx = int(std::floor(px)), cy = int(std::floor(py));
  const int bx = int(std::floor(px - 0.5f)), by = int(std::floor(py - 0.5f));
  const auto inside = [&](int qx, int qy) { return qx >= 0 && qy >= 0 && qx < image.width() && qy < image.height(); };
  std::uint32_t mask = 0;
  for (int i = 0; i < 9; ++i)
    if (inside(cx + i % 3 - 1, cy + i / 3 - 1)) mask |= 1u << i;
  if (inside(bx - 1, by - 1) && inside(bx + 2, by + 2)) mask |= 1u << 9;
  const float fx = px - 0.5f - float(bx), fy = py - 0.5f - float(by);
  float weight[4], sum = 0;
  for (int i = 0; i < 4; ++i) {
    weight[i] = inside(bx + i % 2, by + i / 2) ? (i % 2 ? fx : 1 - fx) * (i / 2 ? fy : 1 - fy) : 0;
    sum += weight[i];
  }
  for (int i = 0; i < 4; ++i) image.at(i, x, y) = sum >= 0.01f ? weight[i] / sum : 0;
  image.bits(4, y)[x] = mask;
}

void fill(Image& image, int type, int take, int x, int y) {
  const Surface s = surface(x, y, image.width(), image.height());
  const auto set = [&](int channel, float value) { image.at(channel, x, y) = value; };
  const float light = 0.4f + 0.3f * std::sin(3 * s.u + s.v);
  switch (type) {
    case QUELL_RADIANCE: {
      const float sample = s.sky ? 1 : one_sample(light, x, y, take);
      for (int c = 0; c < 3; ++c) set(c, s.emitted + sample * (s.sky ? 0.8f : s.albedo[std::size_t(c)]));
      break;
    }
    case QUELL_ALBEDO:
      for (int c = 0; c < 3; ++c) set(c, s.sky ? 0 : s.albedo[std::size_t(c)]);
      break;
    case QUELL_NORMAL:
      for (int c = 0; c < 3; ++c) set(c, s.sky ? 0 : s.normal[std::size_t(c)]);
      break;
    case QUELL_DEPTH:
      set(0, s.sky ? kFar : s.depth);
      break;
    case QUELL_SLOPE:
      set(0, s.sky ? 0 : s.dx), set(1, s.sky ? 0 : s.dy);
      break;
    case QUELL_POSITION:
      set(0, s.sky ? 0 : (s.u - 0.5f) * s.depth), set(1, s.sky ? 0 : (0.5f - s.v) * s.depth),
          set(2, s.sky ? 0 : s.depth);
      break;
    case QUELL_MOTION:
      for (int c = 0; c < 2; ++c) set(c, motion(s)[std::size_t(c)]);
      break;
    case QUELL_ID:
      image.bits(0, y)[x] = s.sky ? kNoId : std::uint32_t(s.object);
      break;
    case QUELL_MOMENTS:
      set(0, light), set(1, light * light * (1.2f + random(x, y, 0, take)));
      break;
    case QUELL_COUNT:
      set(0, 4 + std::floor(8 * random(x, y, 0, take)));
      break;
    case QUELL_TAPS:
      fill_taps(image, x, y, s);
      break;
    case QUELL_VALUE:
      set(0, 1);
      break;
    case QUELL_VARIANCE:
      set(0, light * light * (0.2f + random(x, y, 0, take)));
      break;
    default:  // scalar, features, display
      for (int c = 0; c < image.channels(); ++c) set(c, 0.7f * light + 0.3f * random(x, y, c, take));
  }
}

quell_shape shape_of(int type, int width, int height) {
  const auto* info = type_info(type);
  if (type == QUELL_CAMERA) return {16, 2, 1};
  if (type == QUELL_TRANSFORMS) return {16, kObjects, 1};
  if (info->storage == Storage::value) return {1, 1, 1};
  return {width, height, info->channels ? info->channels : kFeatures};
}

// Objects stand where they are; the camera stands at the origin and looks along z, one unit of x/z as wide as the
// image.
void fill_table(Image& image, int type, int width, int height) {
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < 16; ++x) image.at(0, x, y) = x % 5 == 0 ? 1.0f : 0.0f;
  if (type != QUELL_CAMERA) return;
  const float w = float(width), h = float(height);
  const float screen[16] = {w, 0, w / 2, 0, 0, -h, h / 2, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::copy_n(screen, 16, image.row(0, 1));
}

bool differs_by_take(int type) {
  switch (type) {
    case QUELL_RADIANCE:
    case QUELL_MOMENTS:
    case QUELL_COUNT:
    case QUELL_VARIANCE:
    case QUELL_SCALAR:
    case QUELL_FEATURES:
    case QUELL_DISPLAY:
      return true;
    default:
      return false;
  }
}

}  // namespace

Image synthetic_image(int type, int width, int height, int take) {
  Image image(shape_of(type, width, height));
  if (type_info(type)->storage == Storage::table) {
    fill_table(image, type, width, height);
    return image;
  }
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) fill(image, type, take, x, y);
  return image;
}

Image synthetic_emission(int width, int height) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) image.at(c, x, y) = surface(x, y, width, height).emitted;
  return image;
}

SyntheticSource::SyntheticSource(const Graph& graph, int width, int height, int frames) {
  for (int f = 0; f < frames; ++f) frames_.push_back(f);
  for (const auto& input : graph.inputs) {
    roles_[input.name] = input.type;
    auto& takes = takes_[input.name];
    if (input.name == "emission" && input.type == QUELL_RADIANCE)
      takes.push_back(synthetic_emission(width, height));
    else
      for (int take = 0; take < (differs_by_take(input.type) ? 2 : 1); ++take)
        takes.push_back(synthetic_image(input.type, width, height, take));
  }
}

std::vector<quell_shape> SyntheticSource::shapes(std::int64_t, std::span<const std::string> roles) {
  std::vector<quell_shape> shapes;
  for (const auto& role : roles) shapes.push_back(takes_.at(role)[0].shape());
  return shapes;
}

void SyntheticSource::read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) {
  for (std::size_t i = 0; i < roles.size(); ++i) {
    const auto& takes = takes_.at(roles[i]);
    const Image& from = takes[std::size_t(frame) % takes.size()];
    for (int c = 0; c < from.channels(); ++c)
      for (int y = 0; y < from.height(); ++y)
        std::copy_n(from.row(c, y), from.width(), into[i].plane[c] + y * into[i].pitch);
  }
}

}  // namespace quell
