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

// Shape of the previous frame.
struct Extent {
  int width, height;
  std::ptrdiff_t pitch;
};

// A row of positions as far apart as the pixels themselves: the north-west tap of lane 0.
struct Line {
  int x = 0, y = 0;
};

// Previous positions of a vector of pixels. Pixel centres count as whole numbers, so a position lies in the image where
// it is in [-1/2, size - 1/2).
struct Footprint {
  M inside;         // what follows is meant for these lanes only; the others hold 0
  V fx, fy;         // position between the four bilinear taps, [0, 1]
  I x, y;           // the north-west one; may be -1
  int lines;        // in how many lines they lie: 0 where none is inside, 1, 2, or 3 for more
  Line line, next;  // the first two of them
  M in_next;        // lanes of the second
};

// The line of the first of these lanes, which leaves those beside it.
HWY_INLINE Line line_of(I x, I y, M& lanes) {
  HWY_ALIGN std::int32_t xs[kLanes], ys[kLanes];
  hn::Store(x, di, xs);
  hn::Store(y, di, ys);
  const auto first = hn::FindFirstTrue(d, lanes);
  const Line line{xs[first] - int(first), ys[first]};
  const auto along = hn::And(hn::Eq(x, hn::Iota(di, line.x)), hn::Eq(y, hn::Set(di, line.y)));
  lanes = hn::AndNot(hn::RebindMask(d, along), lanes);
  return line;
}

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
  f.in_next = f.inside;
  f.lines = 0;
  if (HWY_UNLIKELY(hn::AllFalse(d, f.inside))) return f;
  f.line = line_of(f.x, f.y, f.in_next);
  f.lines = 1;
  if (HWY_LIKELY(hn::AllFalse(d, f.in_next))) return f;
  M rest = f.in_next;
  f.next = line_of(f.x, f.y, rest);
  f.lines = hn::AllFalse(d, rest) ? 2 : 3;
  return f;
}

// The square of pixels from kFirst to kFirst + kSide - 1, in both directions, from the north-west taps. Three ways to
// read it, which give the same numbers: loads where the positions lie in one line, …
template <int kFirst, int kSide>
class Straight {
 public:
  HWY_INLINE Straight(const Line& line, const Extent& e) {
    // Rows are held inside, for they are read even where they do not count. Columns beside them lie in the margin.
    for (int j = 0; j < kSide; ++j) {
      const int row = line.y + kFirst + j;
      row_[j] = (row < 0 ? 0 : row >= e.height ? e.height - 1 : row) * e.pitch + line.x + kFirst;
    }
  }
  HWY_INLINE V read(const float* plane, int i, int j) const { return load(plane + row_[j] + i); }

 private:
  std::ptrdiff_t row_[kSide];
};

// … two loads where they lie in two, …
template <int kFirst, int kSide>
class Broken {
 public:
  HWY_INLINE Broken(const Footprint& f, const Extent& e) : first_(f.line, e), then_(f.next, e), in_next_(f.in_next) {}
  HWY_INLINE V read(const float* plane, int i, int j) const {
    return hn::IfThenElse(in_next_, then_.read(plane, i, j), first_.read(plane, i, j));
  }

 private:
  Straight<kFirst, kSide> first_, then_;
  M in_next_;
};

// … and gathers anywhere.
template <int kFirst, int kSide>
class Scattered {
 public:
  HWY_INLINE Scattered(I x, I y, const Extent& e) {
    for (int j = 0; j < kSide; ++j) {
      const I row = held(y + hn::Set(di, kFirst + j), e.height) * hn::Set(di, std::int32_t(e.pitch));
      for (int i = 0; i < kSide; ++i)
        hn::Store(row + held(x + hn::Set(di, kFirst + i), e.width), di, index_[j * kSide + i]);
    }
  }
  HWY_INLINE V read(const float* plane, int i, int j) const {
    return hn::GatherIndex(d, plane, hn::Load(di, index_[j * kSide + i]));
  }

 private:
  static HWY_INLINE I held(I v, int size) { return hn::Min(hn::Max(v, hn::Zero(di)), hn::Set(di, size - 1)); }
  alignas(64) std::int32_t index_[kSide * kSide][kLanes];
};

// Calls use(square) with the quickest of the three.
template <int kFirst, int kSide, class Use>
HWY_INLINE void with_square(const Footprint& f, const Extent& e, Use&& use) {
  if (HWY_LIKELY(f.lines < 2))
    use(Straight<kFirst, kSide>(f.line, e));
  else if (f.lines == 2)
    use(Broken<kFirst, kSide>(f, e));
  else
    use(Scattered<kFirst, kSide>(f.x, f.y, e));
}

QUELL_SIMD_END
#endif
