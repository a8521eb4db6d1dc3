// Conversions and repairs, a row at a time.
#include "core/sequence/conversion.h"

#include "core/report/error.h"
#include "core/sequence/conversion_kernels.h"
#include "core/sequence/pieces.h"

#include <quell/types.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

namespace quell {

namespace {

constexpr float kLargestHalf = 65504.0f;
// Renderers without an infinity write this, or more, as the depth of the sky (Cycles: 1e10 exactly).
constexpr float kFarInFiles = 1e10f;
constexpr int kPieceRows = 32;
constexpr float kShortest = 1e-6f;
// Eight bits cannot say "no direction": the nearest to 0 that they hold has length 0.007.
constexpr float kShortestEncoded = 1.0f / 64.0f;

bool never_negative(int type) {
  return type == QUELL_RADIANCE || type == QUELL_ALBEDO || type == QUELL_VARIANCE || type == QUELL_COUNT;
}

// What a piece of an image had wrong.
struct Found {
  Repairs repairs;
  std::optional<BrokenPixel> broken;
};

// One row of an image: a pointer a channel.
using Row = std::span<float* const>;

// The ray through a pixel, in view space with z = 1.
class Rays {
 public:
  explicit Rays(const FrameMatrices& camera) {
    Matrix view_to_world;
    if (!invert(camera.world_to_view, view_to_world))
      throw Error(Exit::input, "the camera's world-to-view matrix has no inverse, so distances cannot become depths");
    screen_ = camera.world_to_screen * view_to_world;
  }
  // Distance to depth ratio. A point (X, Y, 1)·z projects to (px, py): two linear equations for X and Y.
  double length(double px, double py) const {
    const auto& k = screen_;
    const double a = k[0] - px * k[12], b = k[1] - px * k[13], c = px * k[14] - k[2];
    const double d = k[4] - py * k[12], e = k[5] - py * k[13], f = py * k[14] - k[6];
    const double det = a * e - b * d;
    // All rays of an orthographic camera run along the axis.
    const bool perspective = k[12] != 0 || k[13] != 0 || k[14] != 0;
    if (!perspective || det == 0) return 1;
    const double x = (c * e - b * f) / det, y = (a * f - c * d) / det;
    return std::sqrt(x * x + y * y + 1);
  }

 private:
  Matrix screen_;
};

class Converter {
 public:
  Converter(const quell_image& image, int type, const Window& window, const Conversion& conversion,
            const FrameMatrices* camera)
      : image_(image), type_(type), window_(window), c_(conversion), missing_(type_info(type)->missing) {
    if (c_.needs_camera() && !invert(camera->world_to_view, view_to_world_))
      throw Error(Exit::input, "the camera's world-to-view matrix has no inverse");
    if (c_.distance) rays_.emplace(*camera);
    factor_.assign(std::size_t(image.channels), c_.negate ? -1.0f : 1.0f);
    for (std::size_t i = 0; i < factor_.size(); ++i) {
      if (!c_.scale.empty()) factor_[i] *= c_.scale[std::min(i, c_.scale.size() - 1)];
      if (c_.scale_by_size && i < 2) factor_[i] *= float(i == 0 ? image.width : image.height);
      if (c_.flip_y && i == 1) factor_[i] = -factor_[i];
    }
    encoded_light_ = c_.light.curve != ColorEncoding::Curve::linear;
    per_pixel_ = c_.miss || encoded_light_ || c_.encoded || c_.reciprocal || c_.needs_camera();
  }

  void row(int y, Found& found) const {
    std::vector<float*> planes;
    for (int c = 0; c < image_.channels; ++c) planes.push_back(image_.plane[c] + y * image_.pitch);
    const Row row(planes);
    if (per_pixel_) {
      for (int x = window_.x0; x < window_.x1; ++x) {
        if (is_miss(row, x)) {
          for (float* p : row) p[x] = missing_;
          continue;
        }
        transform(row, x, y);
        repair(row, x, y, found);
      }
      return;
    }
    // Most rows of most images: factors at most, and nothing to repair.
    for (std::size_t i = 0; i < row.size(); ++i)
      if (factor_[i] != 1.0f)
        for (int x = window_.x0; x < window_.x1; ++x) row[i][x] *= factor_[i];
    const auto n = std::size_t(window_.x1 - window_.x0);
    if (type_ == QUELL_DEPTH) {
      if (!found.broken && !all_clean(row[0] + window_.x0, n, true)) find_nan(row[0], y, found);
      found.repairs.non_finite += std::int64_t(far_where_nothing_is(row[0] + window_.x0, n, kFarInFiles));
      return;
    }
    const bool signs = !never_negative(type_);
    if (std::ranges::all_of(row, [&](const float* p) { return all_clean(p + window_.x0, n, signs); })) {
      if (type_ == QUELL_NORMAL) {
        float* const xyz[] = {row[0] + window_.x0, row[1] + window_.x0, row[2] + window_.x0};
        to_unit_length(xyz, n, shortest());
      }
      return;
    }
    for (int x = window_.x0; x < window_.x1; ++x) repair(row, x, y, found);
  }

 private:
  double shortest() const { return c_.encoded ? kShortestEncoded : kShortest; }

  void find_nan(const float* depth, int y, Found& found) const {
    for (int x = window_.x0; x < window_.x1 && !found.broken; ++x)
      if (std::isnan(depth[x])) found.broken = BrokenPixel{x, y, 0, depth[x]};
  }

  bool is_miss(Row row, int x) const {
    if (c_.miss && std::ranges::all_of(row, [&](const float* p) { return p[x] == *c_.miss; })) return true;
    if (!c_.miss_is_camera) return false;
    // The camera's position is the last column; the file has it in float32, and so have the matrices.
    double distance = 0, size = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      const double origin = view_to_world_[4 * i + 3];
      distance = std::max(distance, std::abs(double(row[i][x]) - origin));
      size = std::max(size, std::abs(origin));
    }
    return distance <= 1e-5 * size;
  }

  void transform(Row row, int x, int y) const {
    for (std::size_t i = 0; i < row.size(); ++i) {
      float v = row[i][x];
      if (encoded_light_) v = linear_light(c_.light, v);
      if (c_.encoded) v = 2.0f * v - 1.0f;
      v *= factor_[i];
      if (c_.reciprocal) v = 1.0f / v;
      row[i][x] = v;
    }
    if (rays_ && row[0][x] < kFarInFiles) row[0][x] = float(double(row[0][x]) / rays_->length(x + 0.5, y + 0.5));
    if (c_.from_camera) {
      const double v[3] = {row[0][x], row[1][x], row[2][x]};
      const double w = type_ == QUELL_POSITION ? 1.0 : 0.0;  // a place, or a direction
      for (std::size_t i = 0; i < 3; ++i) {
        const double* m = view_to_world_.data() + 4 * i;
        row[i][x] = float(m[0] * v[0] + m[1] * v[1] + m[2] * v[2] + m[3] * w);
      }
    }
  }

  void repair(Row row, int x, int y, Found& found) const {
    Repairs& repairs = found.repairs;
    if (type_ == QUELL_DEPTH) {
      // An infinite depth is a miss that needs no repair.
      const float z = row[0][x];
      if (std::isnan(z)) ++repairs.non_finite;
      if (std::isnan(z) && !found.broken) found.broken = BrokenPixel{x, y, 0, z};
      if (!std::isfinite(z) || z == 0.0f || z >= kFarInFiles) row[0][x] = kFar;
      return;
    }
    bool finite = true, nan = false, negative = false;
    for (const float* p : row) {
      finite = finite && std::isfinite(p[x]);
      nan = nan || std::isnan(p[x]);
      negative = negative || (p[x] < 0.0f && std::isfinite(p[x]));
    }
    const bool color = type_ == QUELL_RADIANCE || type_ == QUELL_ALBEDO;
    if (!finite) {
      ++repairs.non_finite;
      const auto bad = std::ranges::find_if(row, [x](const float* p) { return !std::isfinite(p[x]); }) - row.begin();
      if (!found.broken) found.broken = BrokenPixel{x, y, int(bad), row[std::size_t(bad)][x]};
      for (float* p : row) {
        if (!color || nan) {
          p[x] = missing_;
        } else if (std::isinf(p[x])) {
          p[x] = p[x] > 0.0f ? kLargestHalf : 0.0f;
        }
      }
      if (!color || nan) return;
    }
    if (negative && never_negative(type_)) {
      repairs.negative += finite;  // counted once, as what is worse
      for (float* p : row) p[x] = std::max(p[x], 0.0f);
    }
    if (type_ == QUELL_NORMAL) {
      const double n[3] = {row[0][x], row[1][x], row[2][x]};
      const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      const double by = length < shortest() ? 0.0 : 1.0 / length;
      for (std::size_t i = 0; i < 3; ++i) row[i][x] = float(n[i] * by);
    }
  }

  const quell_image& image_;
  int type_;
  Window window_;
  const Conversion& c_;
  float missing_;
  Matrix view_to_world_ = kIdentity;
  std::optional<Rays> rays_;
  std::vector<float> factor_;
  bool encoded_light_ = false;
  bool per_pixel_ = false;  // more than factors and repairs
};

// Ids are read as uint32 already.
void convert_ids(const quell_image& image, const Window& window, const Conversion& c) {
  if (!c.miss || !(*c.miss >= 0.0f)) return;
  const auto miss = std::uint32_t(*c.miss);
  for (int y = window.y0; y < window.y1; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(image.plane[0] + y * image.pitch);
    std::replace(row + window.x0, row + window.x1, miss, kNoId);
  }
}

void fill_outside(const quell_image& image, int type, const Window& w) {
  const TypeInfo& info = *type_info(type);
  // As bits, for the bits of an id need not survive a float's register.
  const std::uint32_t value = info.integer ? kNoId : std::bit_cast<std::uint32_t>(info.missing);
  for (int c = 0; c < image.channels; ++c)
    for (int y = 0; y < image.height; ++y) {
      auto* row = reinterpret_cast<std::uint32_t*>(image.plane[c] + y * image.pitch);
      const bool inside = y >= w.y0 && y < w.y1;
      std::fill(row, row + (inside ? w.x0 : image.width), value);
      if (inside) std::fill(row + w.x1, row + image.width, value);
    }
}

}  // namespace

std::optional<BrokenPixel> convert(const quell_image& image, int type, const Window& window,
                                   const Conversion& conversion, const FrameMatrices* camera, Repairs& repairs) {
  const Window inside = window.empty() ? Window{} : window;
  fill_outside(image, type, inside);
  if (type == QUELL_ID) {
    convert_ids(image, inside, conversion);
    return std::nullopt;
  }
  const Converter converter(image, type, inside, conversion, camera);
  std::vector<Found> found(std::size_t((inside.y1 - inside.y0 + kPieceRows - 1) / kPieceRows));
  in_pieces(int(found.size()), [&](int i) {
    const int top = inside.y0 + i * kPieceRows;
    for (int y = top; y < std::min(top + kPieceRows, inside.y1); ++y) converter.row(y, found[std::size_t(i)]);
  });
  std::optional<BrokenPixel> first;
  for (const auto& f : found) {
    repairs.non_finite += f.repairs.non_finite, repairs.negative += f.repairs.negative;
    if (!first) first = f.broken;
  }
  return first;
}

}  // namespace quell
