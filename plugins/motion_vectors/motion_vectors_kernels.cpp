// Projects the pixels of a row into the previous frame, in double: positions times pixels per radian need the digits.
#include "motion_vectors/motion_vectors_kernels.h"

#include <quell/types.h>

#include <quell/simd.h>

QUELL_SIMD_BEGIN

using D = hn::ScalableTag<double>;
using VD = hn::Vec<D>;
using MD = hn::Mask<D>;
constexpr D dd;
constexpr hn::Rebind<float, D> half;
constexpr hn::Rebind<std::int32_t, D> half_i;
constexpr int kDoubles = int(hn::MaxLanes(dd));

// Nearer to the camera plane than this (or behind it), nothing projects.
constexpr double kLeastW = 1e-6;

HWY_INLINE VD same(double value) { return hn::Set(dd, value); }
HWY_INLINE VD from_floats(const float* from) { return hn::PromoteTo(dd, hn::LoadU(half, from)); }

struct Point {
  VD x, y, z;
};
HWY_INLINE VD dot(const double* row, const Point& p) {
  return hn::MulAdd(same(row[0]), p.x, hn::MulAdd(same(row[1]), p.y, same(row[2]) * p.z));
}

// What is known of a vector of pixels, and their motion so far.
struct Pixels {
  Point pixel, position;  // pixel: its centre and 1
  VD x, y;                // motion
};

// Gives these lanes their motion.
HWY_INLINE void go(const Journey& journey, const Point& p, MD lanes, Pixels& out) {
  VD x = hn::Zero(dd), y = x;
  if (journey.past == Past::moved) {
    const double(*m)[4] = journey.matrix;
    const VD w = dot(m[2], p) + same(m[2][3]), inverse = same(1.0) / w;
    x = hn::MulSub(dot(m[0], p) + same(m[0][3]), inverse, out.pixel.x);
    y = hn::MulSub(dot(m[1], p) + same(m[1][3]), inverse, out.pixel.y);
    // Written so that NaN, from a matrix without an inverse, leads out of the image too.
    const VD most = same(double(kNoMotion));
    const MD known = hn::And(w > same(kLeastW), hn::And(hn::Abs(x) < most, hn::Abs(y) < most));
    x = hn::IfThenElse(known, x, most), y = hn::IfThenElse(known, y, most);
  } else if (journey.past == Past::unknown) {
    x = y = same(double(kNoMotion));
  }
  out.x = hn::IfThenElse(lanes, x, out.x), out.y = hn::IfThenElse(lanes, y, out.y);
}

HWY_INLINE Point position_of(const MotionRow& row, int x, const Point& pixel) {
  if (row.position[0])
    return {from_floats(row.position[0] + x), from_floats(row.position[1] + x), from_floats(row.position[2] + x)};
  const Point ray{dot(row.rays[0], pixel), dot(row.rays[1], pixel), dot(row.rays[2], pixel)};
  const VD along = from_floats(row.depth + x) / dot(row.view_z, ray);
  return {hn::MulAdd(ray.x, along, same(row.centre[0])), hn::MulAdd(ray.y, along, same(row.centre[1])),
          hn::MulAdd(ray.z, along, same(row.centre[2]))};
}

HWY_INLINE MD misses(const MotionRow& row, int x, VD id) {
  if (row.id) return id == same(double(std::int32_t(kNoId)));
  if (row.depth) return from_floats(row.depth + x) >= same(0.5 * double(kFar));
  const VD zero = hn::Zero(dd);
  return hn::And(hn::And(from_floats(row.position[0] + x) == zero, from_floats(row.position[1] + x) == zero),
                 from_floats(row.position[2] + x) == zero);
}

void motions(const MotionRow& row, int x0, int x1) {
  const Journey unknown{};
  for (int x = x0; x < x1; x += kDoubles) {
    const int count = x1 - x;
    Pixels p;
    p.pixel = {hn::Iota(dd, x + 0.5), same(row.y + 0.5), same(1.0)};
    p.position = position_of(row, x, p.pixel);
    p.x = p.y = hn::Zero(dd);
    // Numbers of objects as signed ones: all that is asked of them is whether two are the same.
    HWY_ALIGN std::int32_t ids[kDoubles] = {};
    VD id = hn::Zero(dd);
    if (row.id) {
      const auto signed_id = hn::LoadU(half_i, reinterpret_cast<const std::int32_t*>(row.id + x));
      hn::StoreU(signed_id, half_i, ids);
      id = hn::PromoteTo(dd, signed_id);
    }
    MD rest = hn::FirstN(dd, std::size_t(count));
    const MD miss = hn::And(rest, misses(row, x, id));
    if (!hn::AllFalse(dd, miss)) go(row.background, p.pixel, miss, p);
    rest = hn::AndNot(miss, rest);
    if (!row.each_its_own) {
      go(row.objects[0], p.position, rest, p);
    } else {
      for (std::intptr_t lane; (lane = hn::FindFirstTrue(dd, rest)) >= 0;) {  // an object at a time
        const MD its = hn::And(rest, id == same(double(ids[lane])));
        const auto object = std::uint32_t(ids[lane]);
        go(object < row.count ? row.objects[object] : unknown, p.position, its, p);
        rest = hn::AndNot(its, rest);
      }
    }
    const auto within = hn::FirstN(half, std::size_t(count));
    hn::BlendedStore(hn::DemoteTo(half, p.x), within, half, row.motion[0] + x);
    hn::BlendedStore(hn::DemoteTo(half, p.y), within, half, row.motion[1] + x);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(motions);

void motion_row(const MotionRow& row, int x0, int x1) { HWY_DYNAMIC_DISPATCH(motions)(row, x0, x1); }

}  // namespace quell
#endif
