// Reads history through validated taps. For *_kernels.cpp only.

#include <quell/simd.h>

#if defined(QUELL_HISTORY_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUELL_HISTORY_H_
#undef QUELL_HISTORY_H_
#else
#define QUELL_HISTORY_H_
#endif

#include "disocclusion/footprint.h"
#include "disocclusion/taps.h"

QUELL_SIMD_BEGIN

HWY_INLINE Extent extent_of(const TapsRow& row) { return {row.width, row.height, row.pitch}; }

// What the taps of one vector of pixels say.
struct Support {
  HWY_INLINE Support(const TapsRow& row, int x, int count)
      : at(footprint(row.motion[0], row.motion[1], x, row.y, count, row.width, row.height)),
        weight{load(row.weight[0] + x), load(row.weight[1] + x), load(row.weight[2] + x), load(row.weight[3] + x)},
        some{counts(0), counts(1), counts(2), counts(3)},
        mask(hn::LoadU(di, reinterpret_cast<const std::int32_t*>(row.mask + x)) &
             hn::Set(di, std::int32_t(kTapsAround))) {
    const M settled = hn::Or(hn::Or(some[0], some[1]), hn::Or(some[2], some[3]));
    scattered = hn::And(hn::AndNot(settled, at.inside), hn::RebindMask(d, mask > hn::Zero(di)));
  }

  Footprint at;
  V weight[4];
  M some[4];  // taps that count; the others may hold anything
  I mask;
  M scattered;  // no tap counts, but the mask holds valid pixels around the nearest one

 private:
  HWY_INLINE M counts(int k) const { return hn::And(at.inside, weight[k] != zero()); }
};

// Calls use(tap) where tap(k, plane) reads the four taps: 0 where one does not count.
template <class Use>
HWY_INLINE void with_taps(const Support& s, const TapsRow& row, Use&& use) {
  with_square<0, 2>(s.at, extent_of(row), [&](const auto& square) HWY_ATTR {
    use([&](int k, const float* plane)
            HWY_ATTR { return hn::IfThenElseZero(s.some[k], square.read(plane, k % 2, k / 2)); });
  });
}

// Lanes whose 4x4 is valid throughout.
HWY_INLINE M whole_footprints(const Support& s, const TapsRow& row, int x) {
  const I mask = hn::LoadU(di, reinterpret_cast<const std::int32_t*>(row.mask + x));
  return hn::And(s.at.inside, hn::RebindMask(d, hn::TestBit(mask, hn::Set(di, std::int32_t(kTapsWhole)))));
}

// The valid pixels around the positions of a vector, all alike (Schied et al. 2017, section 4.1).
class Neighbourhood {
 public:
  HWY_INLINE Neighbourhood(const Support& s, const TapsRow& row)
      : mask_(s.mask), square_(s.at.x + rounded(s.at.fx), s.at.y + rounded(s.at.fy), extent_of(row)) {}
  HWY_INLINE V mean(const float* plane) const {
    V sum = zero(), n = zero();
    for (int t = 0; t < 9; ++t) {
      const M valid = hn::RebindMask(d, hn::TestBit(mask_, hn::Set(di, 1 << t)));
      sum = sum + hn::IfThenElseZero(valid, square_.read(plane, t % 3, t / 3));
      n = n + hn::IfThenElseZero(valid, all(1.0f));
    }
    return sum / n;
  }

 private:
  static HWY_INLINE I rounded(V fraction) {
    return hn::IfThenElseZero(hn::RebindMask(di, fraction >= all(0.5f)), hn::Set(di, 1));
  }
  I mask_;
  Scattered<-1, 3> square_;
};

QUELL_SIMD_END
#endif
