// Tests the 4x4 previous pixels around each position, and makes weights and mask of the outcome.
#include "disocclusion/disocclusion_kernels.h"

#include "disocclusion/footprint.h"
#include "disocclusion/taps.h"

QUELL_SIMD_BEGIN

constexpr float kMiss = 0.5e30f;  // half of kFar
// Valid taps that hold less of the bilinear weight than this say too little (Falcor's SVGF uses the same number).
constexpr float kLeast = 0.01f;

// The surface that a vector of pixels shows now, and how far another may be from it.
struct Surface {
  V depth, tolerance, nx, ny, nz;
  M depth_miss, normal_miss;
  I id;
};

HWY_INLINE M is_miss(V nx, V ny, V nz) { return hn::And(hn::And(nx == zero(), ny == zero()), nz == zero()); }

HWY_INLINE Surface surface_at(const TapGuides& g, const TapRules& rules, int x) {
  Surface s{};
  if (g.id) s.id = hn::LoadU(di, reinterpret_cast<const std::int32_t*>(g.id + x));
  if (g.depth) {
    s.depth = load(g.depth + x);
    s.depth_miss = s.depth >= all(kMiss);
    const V slopes = g.slope[0] ? hn::Abs(load(g.slope[0] + x)) + hn::Abs(load(g.slope[1] + x)) : zero();
    s.tolerance = all(rules.depth_tolerance) * mul_add(all(rules.depth_floor), s.depth, slopes);
  }
  if (g.normal[0]) {
    s.nx = load(g.normal[0] + x), s.ny = load(g.normal[1] + x), s.nz = load(g.normal[2] + x);
    s.normal_miss = is_miss(s.nx, s.ny, s.nz);
  }
  return s;
}

// Where the previous pixels show the same surface. Misses agree with misses alone.
HWY_INLINE M agrees(const Surface& s, const TapGuides& g, const Around& before, float cosine) {
  M ok = hn::FirstN(d, std::size_t(kLanes));
  if (g.id) ok = hn::RebindMask(d, hn::Eq(s.id, before.read(g.id_before)));
  if (g.depth) {
    const V then = before.read(g.depth_before);
    const M miss = then >= all(kMiss);
    const M near = hn::AndNot(miss, hn::Abs(s.depth - then) <= s.tolerance);
    ok = hn::And(ok, hn::Or(hn::And(s.depth_miss, miss), hn::AndNot(s.depth_miss, near)));
  }
  if (g.normal[0]) {
    const V nx = before.read(g.normal_before[0]), ny = before.read(g.normal_before[1]),
            nz = before.read(g.normal_before[2]);
    const M miss = is_miss(nx, ny, nz);
    const M alike = hn::AndNot(miss, mul_add(s.nx, nx, mul_add(s.ny, ny, s.nz * nz)) >= all(cosine));
    ok = hn::And(ok, hn::Or(hn::And(s.normal_miss, miss), hn::AndNot(s.normal_miss, alike)));
  }
  return ok;
}

// One bit a previous pixel of the 4x4 around the positions, row by row.
HWY_INLINE I valid_bits(const Footprint& f, const TapGuides& g, const TapRules& rules, int x) {
  const Surface s = surface_at(g, rules, x);
  I bits = hn::Zero(di);
  for (int dy = -1; dy <= 2; ++dy) {
    const I v = f.y + hn::Set(di, dy);
    const auto row = hn::And(v > hn::Set(di, -1), v < hn::Set(di, g.height));
    for (int dx = -1; dx <= 2; ++dx) {
      const I u = f.x + hn::Set(di, dx);
      const auto in = hn::And(row, hn::And(u > hn::Set(di, -1), u < hn::Set(di, g.width)));
      const Around before(f, dx, dy, g.width, g.height, g.pitch);
      const M ok = hn::And(hn::RebindMask(d, in), agrees(s, g, before, rules.normal_cosine));
      bits = bits | hn::IfThenElseZero(hn::RebindMask(di, ok), hn::Set(di, 1 << (4 * (dy + 1) + dx + 1)));
    }
  }
  return hn::IfThenElseZero(hn::RebindMask(di, f.inside), bits);
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
    if (f.empty) {
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
