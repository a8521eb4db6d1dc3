// Images as a renderer would give them.
#include "tests/support/typical_input.h"

#include <quell/types.h>

#include <algorithm>
#include <cmath>

namespace quell::test {

namespace {

constexpr int kObjects = 6;
constexpr int kFeatures = 7;
constexpr std::uint32_t kMotionSeed = 77;

// Random numbers in order of use.
class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed * 2654435761u + 1) {}
  std::uint32_t bits() { return state_ = state_ * 1664525u + 1013904223u; }
  float uniform(float low, float high) { return low + (high - low) * float(bits() >> 8) * (1.0f / 16777216.0f); }
  bool one_in(std::uint32_t n) { return (bits() >> 8) % n == 0; }

 private:
  std::uint32_t state_;
};

// Calls fill(x, y, random) for every pixel.
template <class F>
void each(const Image& image, std::uint32_t seed, F&& fill) {
  Random random(seed);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) fill(x, y, random);
}

void fill_radiance(Image& image, std::uint32_t seed) {
  each(image, seed, [&](int x, int y, Random& random) {
    const float scale = random.one_in(50) ? 500.0f : random.one_in(8) ? 0.0f : 2.0f;
    for (int c = 0; c < 3; ++c) image.at(c, x, y) = random.uniform(0, scale);
  });
}

void fill_normal(Image& image, std::uint32_t seed) {
  each(image, seed, [&](int x, int y, Random& random) {
    float n[3], length = 0;
    for (float& v : n) v = random.uniform(-1, 1), length += v * v;
    const bool miss = random.one_in(16) || length < 1e-3f;
    for (int c = 0; c < 3; ++c) image.at(c, x, y) = miss ? 0 : n[c] / std::sqrt(length);
  });
}

void fill_motion(Image& image) {
  each(image, kMotionSeed, [&](int x, int y, Random& random) {
    const bool still = random.one_in(4), far = random.one_in(20);
    for (int c = 0; c < 2; ++c) {
      const float v = random.uniform(-3, 3);
      image.at(c, x, y) = still ? 0 : far ? v * 1000 : v;
    }
  });
}

// Of the motion above: half of the pixels' taps are taken as valid, none of those outside the image are.
void fill_taps(Image& image, std::uint32_t seed) {
  Image motion(image.width(), image.height(), 2);
  fill_motion(motion);
  each(image, seed, [&](int x, int y, Random& random) {
    const float sx = float(x) + 0.5f + motion.at(0, x, y), sy = float(y) + 0.5f + motion.at(1, x, y);
    const int cx = int(std::floor(sx)), cy = int(std::floor(sy));  // pixel under the point: centre of the 3×3
    const int bx = int(std::floor(sx - 0.5f)), by = int(std::floor(sy - 0.5f));
    const float fx = sx - 0.5f - float(bx), fy = sy - 0.5f - float(by);
    const bool all_agree = random.one_in(2);
    std::uint32_t mask = 0;
    for (int i = 0; i < 9; ++i) {
      const int px = cx + i % 3 - 1, py = cy + i / 3 - 1;
      const bool inside = px >= 0 && py >= 0 && px < image.width() && py < image.height();
      if (inside && (all_agree || random.one_in(2))) mask |= 1u << i;
    }
    const bool wide = bx >= 1 && by >= 1 && bx + 2 < image.width() && by + 2 < image.height();
    if (wide && all_agree && mask == 0x1FF) mask |= 1u << 9;
    float weight[4], sum = 0;
    for (int i = 0; i < 4; ++i) {
      const int px = bx + i % 2, py = by + i / 2;
      const int bit = (py - cy + 1) * 3 + (px - cx + 1);
      const bool valid = (mask >> bit & 1u) != 0;
      weight[i] = valid ? (i % 2 ? fx : 1 - fx) * (i / 2 ? fy : 1 - fy) : 0;
      sum += weight[i];
    }
    for (int i = 0; i < 4; ++i) image.at(i, x, y) = sum > 0.01f ? weight[i] / sum : 0;
    image.bits(4, y)[x] = mask;
  });
}

void fill_table(Image& image, int type) {
  const float size = 64;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < 16; ++x) image.at(0, x, y) = x % 5 == 0 ? 1.0f : 0.0f;
  if (type == QUELL_CAMERA) {  // row 1: a pinhole that looks along +z
    const float screen[16] = {size, 0, size / 2, 0, 0, -size, size / 2, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    std::copy_n(screen, 16, image.row(0, 1));
  } else {
    for (int y = 0; y < image.height(); ++y) image.at(0, 3, y) = 0.1f * float(y);
  }
}

}  // namespace

quell_shape typical_shape(int type, int width, int height) {
  if (type == QUELL_VALUE) return {1, 1, 1};
  if (type == QUELL_CAMERA) return {16, 2, 1};
  if (type == QUELL_TRANSFORMS) return {16, kObjects, 1};
  if (type == QUELL_FEATURES) return {width, height, kFeatures};
  return {width, height, type_info(type)->channels};
}

Image typical_input(int type, int width, int height, std::uint32_t seed) {
  Image image(typical_shape(type, width, height));
  const auto uniform = [&](float low, float high) {
    each(image, seed, [&](int x, int y, Random& random) {
      for (int c = 0; c < image.channels(); ++c) image.at(c, x, y) = random.uniform(low, high);
    });
  };
  switch (type) {
    case QUELL_RADIANCE:
      fill_radiance(image, seed);
      break;
    case QUELL_ALBEDO:
      uniform(0, 1);
      each(image, seed + 1, [&](int x, int y, Random& random) {
        if (random.one_in(30)) image.at(0, x, y) = 14;  // an emitter
        if (random.one_in(30)) image.at(1, x, y) = 0;
      });
      break;
    case QUELL_NORMAL:
      fill_normal(image, seed);
      break;
    case QUELL_DEPTH:
      each(image, seed, [&](int x, int y, Random& random) {
        image.at(0, x, y) =
            random.one_in(16) ? kFar : 5.0f + 0.05f * float(x) + 0.02f * float(y) + random.uniform(0, 0.2f);
      });
      break;
    case QUELL_MOTION:
      fill_motion(image);
      break;
    case QUELL_ID:
      each(image, seed, [&](int x, int y, Random& random) {
        image.bits(0, y)[x] = random.one_in(16) ? kNoId : std::uint32_t(x / 5 + y / 7) % kObjects;
      });
      break;
    case QUELL_MOMENTS:
      each(image, seed, [&](int x, int y, Random& random) {
        const float mean = random.uniform(0, 2);
        image.at(0, x, y) = mean;
        image.at(1, x, y) = mean * mean + random.uniform(0, 1);
      });
      break;
    case QUELL_COUNT:
      each(image, seed, [&](int x, int y, Random& random) { image.at(0, x, y) = std::floor(random.uniform(0, 33)); });
      break;
    case QUELL_TAPS:
      fill_taps(image, seed);
      break;
    case QUELL_SLOPE:
      uniform(-0.1f, 0.1f);
      break;
    case QUELL_POSITION:
      each(image, seed, [&](int x, int y, Random& random) {
        for (int c = 0; c < 2; ++c) image.at(c, x, y) = random.uniform(-2, 2);
        image.at(2, x, y) = random.uniform(2, 10);
      });
      break;
    case QUELL_SCALAR:
    case QUELL_FEATURES:
      uniform(-1, 1);
      break;
    case QUELL_CAMERA:
    case QUELL_TRANSFORMS:
      fill_table(image, type);
      break;
    default:
      uniform(0, 1);
      break;  // variance, display, value
  }
  return image;
}

Image missing_input(int type, int width, int height) {
  Image image(typical_shape(type, width, height));
  fill_missing(image.view(), type);
  return image;
}

}  // namespace quell::test
