// What images mean: the one table of types, their channels, conventions and missing values.
#pragma once

#include <quell/abi.h>

#include <cstdint>
#include <string_view>

namespace quell {

// Depth where a ray hit nothing, so that differences of depths are 0 or huge and never NaN.
inline constexpr float kFar = 1e30f;
// Object id where a ray hit nothing.
inline constexpr std::uint32_t kNoId = 0xFFFFFFFFu;

enum class Storage : std::uint8_t { pixels, table, value, none };

struct TypeInfo {
  quell_type type;
  std::string_view name;
  int channels;  // 0: any number; of a table: one plane, a row of 16 numbers per matrix
  Storage storage;
  float missing;  // what every number reads as when history is missing (of a table: the identity)
  bool integer;   // uint32 in place of float32
  std::string_view doc;
};

inline constexpr TypeInfo kTypes[] = {
    {QUELL_RADIANCE, "radiance", 3, Storage::pixels, 0, false, "Linear scene-referred RGB, not negative."},
    {QUELL_ALBEDO, "albedo", 3, Storage::pixels, 0, false,
     "Linear reflectance RGB. Values above 1 are kept (some renderers write an emitter's radiance here)."},
    {QUELL_NORMAL, "normal", 3, Storage::pixels, 0, false, "World space, unit; (0,0,0) where nothing was hit."},
    {QUELL_DEPTH, "depth", 1, Storage::pixels, kFar, false,
     "Linear distance along the view axis, scene units; 1e30 where nothing was hit."},
    {QUELL_SLOPE, "slope", 2, Storage::pixels, 0, false,
     "d depth/dx and d depth/dy, scene units per pixel; one-sided beside a miss or an edge."},
    {QUELL_POSITION, "position", 3, Storage::pixels, 0, false, "World space; 0 where nothing was hit."},
    {QUELL_MOTION, "motion", 2, Storage::pixels, 0, false,
     "Pixels, previous - current, x right, y down, unjittered: previous = current + motion."},
    {QUELL_ID, "id", 1, Storage::pixels, 0, true,
     "Object number, uint32; 0xFFFFFFFF where nothing was hit. Never interpolated."},
    {QUELL_VARIANCE, "variance", 1, Storage::pixels, 0, false, "Variance of the pixel's luminance estimate."},
    {QUELL_MOMENTS, "moments", 2, Storage::pixels, 0, false, "First and second raw moment of luminance."},
    {QUELL_COUNT, "count", 1, Storage::pixels, 0, false, "Frames accumulated; 0 = none."},
    {QUELL_TAPS, "taps", 5, Storage::pixels, 0, false,
     "A reprojection's validated bilinear weights NW NE SW SE (all 0 = disoccluded) and a uint32 mask: bits 0-8 the "
     "valid "
     "pixels of the surrounding 3x3, bit 9 the whole 4x4 footprint is valid."},
    {QUELL_SCALAR, "scalar", 1, Storage::pixels, 0, false, "Any other single channel."},
    {QUELL_FEATURES, "features", 0, Storage::pixels, 0, false, "Any number of channels."},
    {QUELL_DISPLAY, "display", 3, Storage::pixels, 0, false, "Display-encoded RGB in [0,1]: what a PNG holds."},
    {QUELL_VALUE, "value", 1, Storage::value, 0, false, "One number a frame."},
    {QUELL_CAMERA, "camera", 1, Storage::table, 0, false,
     "Two 4x4 matrices, row-major, for column vectors: world to view (x right, y up, z forward), and world to screen "
     "in "
     "pixels (y down, centres at +0.5, to be divided by w)."},
    {QUELL_TRANSFORMS, "transforms", 1, Storage::table, 0, false,
     "One 4x4 matrix an object id, row-major, for column vectors: object to world."},
    {QUELL_WEIGHT, "weight", 0, Storage::none, 0, false, "An edge-stopping function; no image. Cannot be delayed."},
};

// The row of `type`, or nullptr for a number that is no type. QUELL_ANY has no row.
constexpr const TypeInfo* type_info(int type) {
  for (const auto& t : kTypes)
    if (t.type == type) return &t;
  return nullptr;
}
constexpr const TypeInfo* type_info(std::string_view name) {
  for (const auto& t : kTypes)
    if (t.name == name) return &t;
  return nullptr;
}
constexpr std::string_view type_name(int type) {
  if (type == QUELL_ANY) return "any";
  const auto* t = type_info(type);
  return t ? t->name : std::string_view("?");
}

// Tags for ports: In<Radiance>, Out<Any>.
template <int Type>
struct Is {
  static constexpr int type = Type;
};
using Radiance = Is<QUELL_RADIANCE>;
using Albedo = Is<QUELL_ALBEDO>;
using Normal = Is<QUELL_NORMAL>;
using Depth = Is<QUELL_DEPTH>;
using Slope = Is<QUELL_SLOPE>;
using Position = Is<QUELL_POSITION>;
using Motion = Is<QUELL_MOTION>;
using Id = Is<QUELL_ID>;
using Variance = Is<QUELL_VARIANCE>;
using Moments = Is<QUELL_MOMENTS>;
using Count = Is<QUELL_COUNT>;
using Taps = Is<QUELL_TAPS>;
using Scalar = Is<QUELL_SCALAR>;
using Features = Is<QUELL_FEATURES>;
using Display = Is<QUELL_DISPLAY>;
using Value = Is<QUELL_VALUE>;
using Camera = Is<QUELL_CAMERA>;
using Transforms = Is<QUELL_TRANSFORMS>;
using Weight = Is<QUELL_WEIGHT>;
using Any = Is<QUELL_ANY>;

}  // namespace quell
