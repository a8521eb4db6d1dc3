// Tests the 4x4 previous pixels around each position, and makes weights and mask of the outcome.
#include "disocclusion/disocclusion_kernels.h"

#include "disocclusion/footprint.h"
#include "disocclusion/taps.h"

QUELL_SIMD_BEGIN

constexpr float kMiss = 0.5e30f;            // half of kFar
constexpr float kNoMiss = 0x1.93e592p+98f;  // the number before it
// Valid taps that hold less of the bilinear weight than this say too little (Falcor's SVGF uses the same number).
constexpr float kLeast = 0.01f;

// One bit for each previous pixel of the 4x4 around a position, row by row, for which test(column, row) holds.
template <class Test>
HWY_INLINE I bits_where(Test test) {
  I bits = hn::Zero(di);
  HWY_UNROLL(4)
  for (int j = 0; j < 4; ++j) {
    HWY_UNROLL(4)
    for (int i = 0; i < 4; ++i)
      bits = bits | hn::IfThenElseZero(hn::RebindMask(di, test(i, j)), hn::Set(di, 1 << (4 * j + i)));
  }
  return bits;
}

HWY_INLINE I load_bits(const std::uint32_t* from) { return hn::LoadU(di, reinterpret_cast<const std::int32_t*>(from)); }

template <class Square>
HWY_INLINE I same_id(const TapGuides& g, int x, const Square& square) {
  const I now = load_bits(g.id + x);
  const auto* before = reinterpret_cast<const float*>(g.id_before);
  return bits_where([&](int i, int j) HWY_ATTR {
    return hn::RebindMask(d, hn::Eq(hn::BitCast(di, square.read(before, i, j)), now));
  });
}

// Depths between two limits; where the pixel is a miss, misses.
template <class Square>
HWY_INLINE I near_depth(const TapGuides& g, const TapRules& rules, int x, const Square& square) {
  const V depth = load(g.depth + x), miss = all(kMiss);
  const V slopes = g.slope[0] ? hn::Abs(load(g.slope[0] + x)) + hn::Abs(load(g.slope[1] + x)) : zero();
  const V tolerance = all(rules.depth_tolerance) * mul_add(all(rules.depth_floor), depth, slopes);
  const M is_miss = depth >= miss;
  const V least = hn::IfThenElse(is_miss, miss, depth - tolerance);
  const V most = hn::IfThenElse(is_miss, all(HUGE_VALF), hn::Min(depth + tolerance, all(kNoMiss)));
  return bits_where([&](int i, int j) HWY_ATTR {
    const V then = square.read(g.depth_before, i, j);
    return hn::And(then >= least, then <= most);
  });
}

HWY_INLINE M is_miss(V nx, V ny, V nz) { return hn::Or3(nx, ny, nz) == zero(); }

template <class Square>
HWY_INLINE I like_normal(const TapGuides& g, const TapRules& rules, int x, const Square& square) {
  const V nx = load(g.normal[0] + x), ny = load(g.normal[1] + x), nz = load(g.normal[2] + x);
  const V least = all(rules.normal_cosine);
  const M miss = is_miss(nx, ny, nz);
  const auto cosine = [&](V x_then, V y_then, V z_then)
                          HWY_ATTR { return mul_add(nx, x_then, mul_add(ny, y_then, nz * z_then)); };
  // The cosine with a miss is 0, which tells it from surfaces that agree unless these may stand at a right angle.
  if (HWY_LIKELY(rules.normal_cosine > 0 && hn::AllFalse(d, miss)))
    return bits_where([&](int i, int j) HWY_ATTR {
      return cosine(square.read(g.normal_before[0], i, j), square.read(g.normal_before[1], i, j),
                    square.read(g.normal_before[2], i, j)) >= least;
    });
  return bits_where([&](int i, int j) HWY_ATTR {
    const V x_then = square.read(g.normal_before[0], i, j), y_then = square.read(g.normal_before[1], i, j),
            z_then = square.read(g.normal_before[2], i, j);
    const M miss_then = is_miss(x_then, y_then, z_then);
    return hn::Or(hn::And(miss, miss_then),
                  hn::AndNot(hn::Or(miss, miss_then), cosine(x_then, y_then, z_then) >= least));
  });
}

// Positions near the plane that the surface lies in. That of a miss, which has no normal, holds everything; the test of
// normals sees to misses.
template <class Square>
HWY_INLINE I in_plane(const TapGuides& g, const TapRules& rules, int x, const Square& square) {
  const V nx = load(g.normal[0] + x), ny = load(g.normal[1] + x), nz = load(g.normal[2] + x);
  const V px = load(g.position[0] + x), py = load(g.position[1] + x), pz = load(g.position[2] + x);
  const V tolerance = all(rules.plane_tolerance) * load(g.depth + x);
  return bits_where([&](int i, int j) HWY_ATTR {
    const V dx = square.read(g.position_before[0], i, j) - px, dy = square.read(g.position_before[1], i, j) - py,
            dz = square.read(g.position_before[2], i, j) - pz;
    return hn::Abs(mul_add(nx, dx, mul_add(ny, dy, nz * dz))) <= tolerance;
  });
}

// The pixels of the 4x4 that lie in the image.
HWY_INLINE I in_image(const Footprint& f, const TapGuides& g) {
  return bits_where([&](int i, int j) HWY_ATTR {
    const I x = f.x + hn::Set(di, i - 1), y = f.y + hn::Set(di, j - 1);
    const auto in_row = hn::And(x > hn::Set(di, -1), x < hn::Set(di, g.width));
    return hn::RebindMask(d, hn::And(in_row, hn::And(y > hn::Set(di, -1), y < hn::Set(di, g.height))));
  });
}

// The pixels of the 4x4 that show the same surface by all guides.
HWY_INLINE I valid_bits(const Footprint& f, const TapGuides& g, const TapRules& rules, int x) {
  I bits = hn::IfThenElseZero(hn::RebindMask(di, f.inside), hn::Set(di, 0xFFFF));
  with_square<-1, 4>(f, {g.width, g.height, g.pitch}, [&](const auto& square) HWY_ATTR {
    if (g.id) bits = bits & same_id(g, x, square);
    if (g.depth) bits = bits & near_depth(g, rules, x, square);
    if (g.normal[0]) bits = bits & like_normal(g, rules, x, square);
    if (g.position[0]) bits = bits & in_plane(g, rules, x, square);
  });
  const bool within =
      f.lines == 1 && f.line.x >= 1 && f.line.x + kLanes + 2 <= g.width && f.line.y >= 1 && f.line.y + 3 <= g.height;
  return HWY_LIKELY(within) ? bits : bits & in_image(f, g);
}

// The 3x3 around the nearest pixel out of the 4x4, and whether all of that is valid.
HWY_INLINE I mask_of(I bits, M east, M south) {
  I s = hn::IfThenElse(hn::RebindMask(di, east), hn::ShiftRight<1>(bits), bits);
  s = hn::IfThenElse(hn::RebindMask(di, south), hn::ShiftRight<4>(s), s);
  const I three = hn::Set(di, 7);
  const I around =
      (s & three) | hn::ShiftLeft<3>(hn::ShiftRight<4>(s) & three) | hn::ShiftLeft<6>(hn::ShiftRight<8>(s) & three);
  return around | hn::IfThenElseZero(hn::Eq(bits, hn::Set(di, 0xFFFF)), hn::Set(di, std::int32_t(kTapsWhole)));
}

HWY_INLINE void store_bits(I v, std::uint32_t* to, int count) {
  store(hn::BitCast(d, v), reinterpret_cast<float*>(to), count);
}

void row_of_taps(const TapGuides& g, const TapRules& rules, int y, int x0, int x1, float* const* weight,
                 std::uint32_t* mask) {
  for (int x = x0; x < x1; x += kLanes) {
    const int count = x1 - x;
    const Footprint f = footprint(g.motion[0], g.motion[1], x, y, count, g.width, g.height);
    if (f.lines == 0) {
      for (int t = 0; t < 4; ++t) store(zero(), weight[t] + x, count);
      store_bits(hn::Zero(di), mask + x, count);
      continue;
    }
    const I bits = valid_bits(f, g, rules, x);
    const M east = f.fx >= all(0.5f), south = f.fy >= all(0.5f);
    const V one = all(1.0f);
    V wx1 = f.fx, wy1 = f.fy;
    if (rules.mode == TapMode::nearest) wx1 = hn::IfThenElseZero(east, one), wy1 = hn::IfThenElseZero(south, one);
    const V wx0 = one - wx1, wy0 = one - wy1;
    const auto where = [bits](int bit, V w) HWY_ATTR {
      return hn::IfThenElseZero(hn::RebindMask(d, hn::TestBit(bits, hn::Set(di, 1 << bit))), w);
    };
    const V w[4] = {where(5, wx0 * wy0), where(6, wx1 * wy0), where(9, wx0 * wy1), where(10, wx1 * wy1)};
    const V sum = (w[0] + w[1]) + (w[2] + w[3]);
    const M enough = sum >= all(kLeast);
    for (int t = 0; t < 4; ++t) store(hn::IfThenElseZero(enough, w[t] / sum), weight[t] + x, count);
    I m = mask_of(bits, east, south);
    if (!rules.fallback) m = hn::IfThenElseZero(hn::RebindMask(di, enough), m);
    store_bits(m, mask + x, count);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(row_of_taps);

void validate_taps(const TapGuides& g, const TapRules& rules, int y, int x0, int x1, float* const weight[4],
                   std::uint32_t* mask) {
  HWY_DYNAMIC_DISPATCH(row_of_taps)(g, rules, y, x0, x1, weight, mask);
}

}  // namespace quell
#endif
