// Selects pixels by the rank of their luminance, a vector of windows at once.
#include "outlier_rank/outlier_rank_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

// A pixel of a window; `order` is its luminance, or the negative of it where the darkest come first.
struct Candidate {
  V order, r, g, b;
};
HWY_INLINE Candidate either(M which, const Candidate& yes, const Candidate& no) {
  return {hn::IfThenElse(which, yes.order, no.order), hn::IfThenElse(which, yes.r, no.r),
          hn::IfThenElse(which, yes.g, no.g), hn::IfThenElse(which, yes.b, no.b)};
}

// The kRank greatest so far, greatest first; of equals, the earlier one.
template <int kRank>
class Greatest {
 public:
  HWY_INLINE void add(Candidate c) {
    for (auto& kept : list_) {
      const M greater = c.order > kept.order;
      const Candidate next = either(greater, kept, c);
      kept = either(greater, c, kept);
      c = next;
    }
  }
  HWY_INLINE const Candidate& last() const { return list_[kRank - 1]; }
  HWY_INLINE void clear() {
    for (auto& kept : list_) kept = {all(-HUGE_VALF), zero(), zero(), zero()};
  }

 private:
  Candidate list_[kRank];
};

HWY_INLINE Candidate pixel(const RankWindow& w, std::ptrdiff_t at) {
  const V r = load(w.plane[0] + at), g = load(w.plane[1] + at), b = load(w.plane[2] + at);
  return {luminance(r, g, b), r, g, b};
}

template <int kRank>
HWY_INLINE void select(const RankWindow& w, int y, int x0, int x1, float* const* out) {
  const int top = y < w.radius ? 0 : y - w.radius, bottom = y + w.radius < w.height ? y + w.radius : w.height - 1;
  for (int x = x0; x < x1; x += kLanes) {
    const std::ptrdiff_t at = y * w.pitch + x;
    const Candidate centre = pixel(w, at);
    const I object = w.id ? hn::BitCast(di, load(w.id + at)) : hn::Zero(di);
    const V column = lane_numbers() + all(float(x));
    Greatest<kRank> brightest, darkest;
    brightest.clear(), darkest.clear();
    for (int v = top; v <= bottom; ++v)
      for (int dx = -w.radius; dx <= w.radius; ++dx) {
        if (v == y && dx == 0) continue;
        const std::ptrdiff_t there = v * w.pitch + x + dx;
        const V u = column + all(float(dx));
        M counts = hn::And(u >= zero(), u < all(float(w.width)));
        if (w.id) counts = hn::And(counts, hn::RebindMask(d, hn::BitCast(di, load(w.id + there)) == object));
        Candidate c = pixel(w, there);
        const V bright = c.order;
        c.order = hn::IfThenElse(counts, bright, all(-HUGE_VALF));
        brightest.add(c);
        c.order = hn::IfThenElse(counts, zero() - bright, all(-HUGE_VALF));
        darkest.add(c);
      }
    // Where there are too few neighbours, the limit is infinite.
    const V most = brightest.last().order, least = zero() - darkest.last().order;
    const M too_bright = hn::And(centre.order > most, most > all(-HUGE_VALF));
    const M too_dark = hn::And(centre.order < least, least < all(HUGE_VALF));
    const Candidate to = either(too_bright, brightest.last(), either(too_dark, darkest.last(), centre));
    store(to.r, out[0] + x, x1 - x);
    store(to.g, out[1] + x, x1 - x);
    store(to.b, out[2] + x, x1 - x);
  }
}

void select_row(const RankWindow& w, int rank, int y, int x0, int x1, float* const* out) {
  switch (rank) {
    case 1:
      return select<1>(w, y, x0, x1, out);
    case 2:
      return select<2>(w, y, x0, x1, out);
    case 3:
      return select<3>(w, y, x0, x1, out);
    default:
      return select<4>(w, y, x0, x1, out);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(select_row);
void select_by_rank(const RankWindow& w, int rank, int y, int x0, int x1, float* const out[3]) {
  HWY_DYNAMIC_DISPATCH(select_row)(w, rank, y, x0, x1, out);
}

}  // namespace quell
#endif
