// Where pixels were in the previous frame: the one reading of motion that disocclusion, reproject and history_length
// share. For *_kernels.cpp only.

#include <quell/simd.h>

#if defined(QUELL_FOOTPRINT_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUELL_FOOTPRINT_H_
#undef QUELL_FOOTPRINT_H_
#else
#define QUELL_FOOTPRINT_H_
#endif

QUELL_SIMD_BEGIN

// Previous positions of a vector of pixels. Pixel centres count as whole numbers, so a position lies in the image where
// it is in [-1/2, size - 1/2).
struct Footprint {
  M inside;       // what follows is meant for these lanes only; the others hold 0
  V fx, fy;       // position between the four bilinear taps, [0, 1]
  I x, y;         // the north-west one; may be -1
  bool straight;  // all lanes that are inside lie in one row, as far apart as the pixels themselves
  int x0, y0;     // then: north-west tap of lane 0
  bool empty;     // none is inside
};

// Pixels x, x + 1, … of row y, of which the first `count` matter. Motion that is NaN leads out of the image.
HWY_INLINE Footprint footprint(const float* motion_x, const float* motion_y, int x, int y, int count, int width,
                               int height) {
  const V px = lane_numbers() + all(float(x)) + load(motion_x + x), py = all(float(y)) + load(motion_y + x);
  const V low = all(-0.5f);
  Footprint f;
  f.inside = hn::And(
      hn::And(hn::And(px >= low, px < all(float(width) - 0.5f)), hn::And(py >= low, py < all(float(height) - 0.5f))),
      hn::FirstN(d, std::size_t(count)));
  const V bx = hn::IfThenElseZero(f.inside, hn::Floor(px)), by = hn::IfThenElseZero(f.inside, hn::Floor(py));
  f.fx = hn::IfThenElseZero(f.inside, px - bx);
  f.fy = hn::IfThenElseZero(f.inside, py - by);
  f.x = hn::ConvertTo(di, bx);
  f.y = hn::ConvertTo(di, by);
  const auto first = hn::FindFirstTrue(d, f.inside);
  f.empty = first < 0;
  f.straight = f.empty;
  f.x0 = f.y0 = 0;
  if (f.empty) return f;
  HWY_ALIGN std::int32_t xs[kLanes], ys[kLanes];
  hn::Store(f.x, di, xs);
  hn::Store(f.y, di, ys);
  f.x0 = xs[first] - int(first);
  f.y0 = ys[first];
  const auto in_line = hn::And(hn::Eq(f.x, hn::Iota(di, f.x0)), hn::Eq(f.y, hn::Set(di, f.y0)));
  f.straight = hn::AllTrue(d, hn::Or(hn::RebindMask(d, in_line), hn::Not(f.inside)));
  return f;
}

// The pixels (dx, dy) from the north-west taps of a vector of positions: read by loads where they lie in line and by
// gathers where not, which gives the same numbers.
class Around {
 public:
  HWY_INLINE Around(const Footprint& f, int dx, int dy, int width, int height, std::ptrdiff_t pitch)
      : straight_(f.straight) {
    if (straight_) {
      // The row is held inside, for it is read even where it does not count. Columns beside it lie in the margin.
      const int row = f.y0 + dy;
      offset_ = (row < 0 ? 0 : row >= height ? height - 1 : row) * pitch + f.x0 + dx;
      index_ = hn::Zero(di);
    } else {
      offset_ = 0;
      const I x = hn::Min(hn::Max(f.x + hn::Set(di, dx), hn::Zero(di)), hn::Set(di, width - 1));
      const I y = hn::Min(hn::Max(f.y + hn::Set(di, dy), hn::Zero(di)), hn::Set(di, height - 1));
      index_ = y * hn::Set(di, std::int32_t(pitch)) + x;
    }
  }
  HWY_INLINE V read(const float* plane) const {
    return straight_ ? load(plane + offset_) : hn::GatherIndex(d, plane, index_);
  }
  HWY_INLINE I read(const std::uint32_t* plane) const {
    const auto* p = reinterpret_cast<const std::int32_t*>(plane);
    return straight_ ? hn::LoadU(di, p + offset_) : hn::GatherIndex(di, p, index_);
  }

 private:
  bool straight_;
  std::ptrdiff_t offset_;
  I index_;
};

QUELL_SIMD_END
#endif
