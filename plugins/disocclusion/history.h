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

// What the taps of one vector of pixels say.
struct Support {
  Footprint at;
  V weight[4];
  M some[4];    // taps that count; the others may hold anything
  M scattered;  // no tap counts, but the mask holds valid pixels around the nearest one
};

HWY_INLINE Support support_at(const TapsRow& row, int x, int count) {
  Support s;
  s.at = footprint(row.motion[0], row.motion[1], x, row.y, count, row.width, row.height);
  M settled = hn::Not(s.at.inside);
  for (int k = 0; k < 4; ++k) {
    s.weight[k] = load(row.weight[k] + x);
    s.some[k] = hn::And(s.at.inside, s.weight[k] != zero());
    settled = hn::Or(settled, s.some[k]);
  }
  const I mask = hn::LoadU(di, reinterpret_cast<const std::int32_t*>(row.mask + x));
  const I around = mask & hn::Set(di, std::int32_t(kTapsAround));
  s.scattered = hn::AndNot(settled, hn::RebindMask(d, around > hn::Zero(di)));
  return s;
}

// The four taps, to be read of any plane.
class TapReader {
 public:
  HWY_INLINE TapReader(const Support& s, const TapsRow& r)
      : s_(s),
        tap_{{s.at, 0, 0, r.width, r.height, r.pitch},
             {s.at, 1, 0, r.width, r.height, r.pitch},
             {s.at, 0, 1, r.width, r.height, r.pitch},
             {s.at, 1, 1, r.width, r.height, r.pitch}} {}
  // 0 where the tap does not count.
  HWY_INLINE V read(int tap, const float* plane) const {
    return hn::IfThenElseZero(s_.some[tap], tap_[tap].read(plane));
  }

 private:
  const Support& s_;
  Around tap_[4];
};

HWY_INLINE int held(int v, int size) { return v < 0 ? 0 : v >= size ? size - 1 : v; }

// Pixel that holds a position of a footprint, which is at least -1/2.
HWY_INLINE int nearest(float position) {
  const int whole = int(position);
  return whole + (position - float(whole) >= 0.5f);
}

// Mean of the valid pixels around the position of pixel x, all alike (Schied et al. 2017, section 4.1).
HWY_INLINE float mean_around(const TapsRow& row, const float* plane, int x) {
  const int at_x = nearest(float(x) + row.motion[0][x]), at_y = nearest(float(row.y) + row.motion[1][x]);
  float sum = 0, n = 0;
  for (int t = 0; t < 9; ++t)
    if (row.mask[x] >> t & 1) {
      sum += plane[held(at_y + t / 3 - 1, row.height) * row.pitch + held(at_x + t % 3 - 1, row.width)];
      ++n;
    }
  return sum / n;
}

// Calls use(x) for each pixel of the vector at x whose history is scattered.
template <class Use>
HWY_INLINE void each_scattered(const Support& s, int x, int count, Use&& use) {
  if (hn::AllFalse(d, s.scattered)) return;
  HWY_ALIGN float flag[kLanes];
  hn::Store(hn::IfThenElseZero(s.scattered, all(1.0f)), d, flag);
  for (int i = 0; i < kLanes && i < count; ++i)
    if (flag[i] != 0) use(x + i);
}

QUELL_SIMD_END
#endif
