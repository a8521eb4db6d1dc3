// The gather engine: a weighted sum over taps, in segments of a row that stay in the first-level cache.
//
// For *_kernels.cpp only. gather(g, x, y, n, sums) leaves for each pixel of a segment W = Σw, Σw·v of each plane and
// Σw²·variance, where w = kernel · 2^-(sum of the weight nodes' exponents) and the centre counts with its kernel weight
// alone, so that W > 0 always. Taps outside the image count for nothing; neither do exponents that are not below 126,
// NaN among them. What a pixel gets does not depend on the segment that it lies in.

#include <quell/simd.h>

#if defined(QUELL_GATHER_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUELL_GATHER_H_
#undef QUELL_GATHER_H_
#else
#define QUELL_GATHER_H_
#endif

#include <quell/taps.h>

QUELL_SIMD_BEGIN

// Floats from a tap's exponents to the next's: no multiple of 4096 bytes, so that they do not compete for cache sets.
constexpr std::ptrdiff_t kExponentRow = QUELL_SEGMENT + 16;

// Where the means of a segment go in place of sums: each plane's weighted mean, and the variance of a weighted mean of
// independent values, Σw²·variance / W².
struct Means {
  float* const* plane;
  float* variance;  // or null
  std::ptrdiff_t at;
};

struct Batch {
  quell_run run;
  const float* log2_kernel;
  float* exponent;
  bool first;          // begins the sums, with the centre
  const Means* means;  // ends them, where not null
};

// Weight of a tap. Exponents beyond the range of floats are no weight at all, which also spares denormals; neither is
// NaN.
HWY_INLINE V weight_of(V log2_kernel, V exponent) { return exp2_or_zero(log2_kernel - exponent); }

// A neighbour's value. Beside the image's border what has no weight may be anything, NaN too, so 0 times it must not be
// taken.
template <bool kBorder>
HWY_INLINE V value_of(const float* from, V weight) {
  const V v = load(from);
  return kBorder ? hn::IfThenElseZero(weight > zero(), v) : v;
}

// Where a batch is gathered from, and the sums that it is added to; where the segment's means go, and their variance.
struct Target {
  const float* plane[3];
  const float* variance;
  float* sum[3];
  float *sum_weight, *sum_variance;
  float* mean[3];
  float* mean_variance;
};

// What one vector of pixels has gathered: one or three planes, and with three the variance. `kAt` is how far the vector
// lies from the place that is named.
template <int kPlanes, bool kVariance, bool kBorder, int kAt>
class Gathered {
 public:
  // From the centre on, which counts with its kernel weight alone …
  HWY_INLINE Gathered(const Target& from, float centre, std::ptrdiff_t at) {
    const V c = all(centre);
    s0_ = c * load(from.plane[0] + at + kAt);
    s1_ = kPlanes > 1 ? c * load(from.plane[kSecond] + at + kAt) : c;
    s2_ = kPlanes > 1 ? c * load(from.plane[kThird] + at + kAt) : c;
    weight_ = c;
    variance_ = kVariance ? c * c * load(from.variance + at + kAt) : c;
  }
  // … or from what has been summed.
  HWY_INLINE Gathered(const Target& to, int i)
      : s0_(load(to.sum[0] + i + kAt)),
        s1_(load(to.sum[kSecond] + i + kAt)),
        s2_(load(to.sum[kThird] + i + kAt)),
        weight_(load(to.sum_weight + i + kAt)),
        variance_(kVariance ? load(to.sum_variance + i + kAt) : weight_) {}

  HWY_INLINE void add(V log2_kernel, const float* exponent, const Target& from, std::ptrdiff_t at) {
    const V w = weight_of(log2_kernel, load(exponent + kAt));
    s0_ = mul_add(w, value_of<kBorder>(from.plane[0] + at + kAt, w), s0_);
    if constexpr (kPlanes > 1) {
      s1_ = mul_add(w, value_of<kBorder>(from.plane[kSecond] + at + kAt, w), s1_);
      s2_ = mul_add(w, value_of<kBorder>(from.plane[kThird] + at + kAt, w), s2_);
    }
    if constexpr (kVariance) variance_ = mul_add(w * w, value_of<kBorder>(from.variance + at + kAt, w), variance_);
    weight_ = weight_ + w;
  }

  HWY_INLINE void keep(const Target& to, int i) const {
    store(s0_, to.sum[0] + i + kAt);
    if constexpr (kPlanes > 1) {
      store(s1_, to.sum[kSecond] + i + kAt);
      store(s2_, to.sum[kThird] + i + kAt);
    }
    if constexpr (kVariance) store(variance_, to.sum_variance + i + kAt);
    store(weight_, to.sum_weight + i + kAt);
  }
  // The means of the first `count` pixels.
  HWY_INLINE void finish(const Target& to, int i, int count) const {
    if (count <= 0) return;
    const V inverse = all(1.0f) / weight_;
    store(s0_ * inverse, to.mean[0] + i + kAt, count);
    if constexpr (kPlanes > 1) {
      store(s1_ * inverse, to.mean[kSecond] + i + kAt, count);
      store(s2_ * inverse, to.mean[kThird] + i + kAt, count);
    }
    if constexpr (kVariance) store(variance_ * (inverse * inverse), to.mean_variance + i + kAt, count);
  }

 private:
  static constexpr int kSecond = kPlanes > 1 ? 1 : 0, kThird = kPlanes > 1 ? 2 : 0;
  V s0_, s1_, s2_, weight_, variance_;
};

// Adds a batch to the sums, weights straight from the exponents; the first batch begins with the centre, the last may
// leave the means in place of the sums. Two vectors a step pay where there are registers for them; a function of its
// own, for its loop needs all registers of the machine.
template <int kPlanes, bool kVariance, bool kBorder>
HWY_FLATTEN HWY_NOINLINE void add_by_exponent(const Batch& batch, float centre, const Target& where) {
  constexpr bool kTwo = HWY_TARGET <= HWY_AVX3;
  using A = Gathered<kPlanes, kVariance, kBorder, 0>;
  using B = Gathered<kPlanes, kVariance, kBorder, kTwo ? kLanes : 0>;
  const Target target = where;
  const quell_run run = batch.run;
  const float* const log2_kernel = batch.log2_kernel;
  const bool first = batch.first, last = batch.means != nullptr;
  for (int i = 0; i < run.n; i += (kTwo ? 2 : 1) * kLanes) {
    A a = first ? A(target, centre, run.at + i) : A(target, i);
    B b = first ? B(target, centre, run.at + i) : B(target, i);
    const float* e = batch.exponent + i;
    for (int t = 0; t < run.taps; ++t, e += run.row) {
      const V k = all(log2_kernel[t]);
      const std::ptrdiff_t at = run.at + run.tap[t].offset + i;
      a.add(k, e, target, at);
      if constexpr (kTwo) b.add(k, e, target, at);
    }
    last ? a.finish(target, i, run.n - i) : a.keep(target, i);
    if constexpr (kTwo) last ? b.finish(target, i, run.n - i - kLanes) : b.keep(target, i);
  }
}

// For any number of planes: turns the exponents into weights once, in place, …
inline void weights_in_place(const Batch& batch, float* sum_weight) {
  const quell_run& run = batch.run;
  for (int i = 0; i < run.n; i += kLanes) {
    V sw = load(sum_weight + i);
    float* e = batch.exponent + i;
    for (int t = 0; t < run.taps; ++t, e += run.row) {
      const V w = weight_of(all(batch.log2_kernel[t]), load(e));
      sw = sw + w;
      store(w, e);
    }
    store(sw, sum_weight + i);
  }
}
// … and adds up to three planes at a time, or the variance by squared weights; two vectors a step, for one alone waits
// for its sums.
template <int kPlanes, bool kSquared, bool kBorder>
HWY_FLATTEN HWY_NOINLINE void add_by_weight(const Batch& batch, const float* const* plane, float* const* sum) {
  const quell_run run = batch.run;
  const float* from[kPlanes];
  for (int p = 0; p < kPlanes; ++p) from[p] = plane[p];
  for (int i = 0; i < run.n; i += 2 * kLanes) {
    V a[kPlanes], b[kPlanes];
    HWY_UNROLL(3)
    for (int p = 0; p < kPlanes; ++p) a[p] = load(sum[p] + i), b[p] = load(sum[p] + i + kLanes);
    const float* w = batch.exponent + i;
    for (int t = 0; t < run.taps; ++t, w += run.row) {
      const V wa = load(w), wb = load(w + kLanes);
      const V by_a = kSquared ? wa * wa : wa, by_b = kSquared ? wb * wb : wb;
      const std::ptrdiff_t at = run.at + run.tap[t].offset + i;
      HWY_UNROLL(3)
      for (int p = 0; p < kPlanes; ++p) {
        a[p] = mul_add(by_a, value_of<kBorder>(from[p] + at, wa), a[p]);
        b[p] = mul_add(by_b, value_of<kBorder>(from[p] + at + kLanes, wb), b[p]);
      }
    }
    HWY_UNROLL(3)
    for (int p = 0; p < kPlanes; ++p) store(a[p], sum[p] + i), store(b[p], sum[p] + i + kLanes);
  }
}
template <bool kBorder>
void add_planes_by_weight(const Gather& g, const Batch& batch, Sums& sums) {
  const std::size_t planes = g.planes.size();
  for (std::size_t p = 0; p < planes; p += 3) {
    // Sums has two rows behind those of the planes.
    float* const sum[3] = {sums.plane(p), sums.plane(p + 1), sums.plane(p + 2)};
    planes - p == 1   ? add_by_weight<1, false, kBorder>(batch, &g.planes[p], sum)
    : planes - p == 2 ? add_by_weight<2, false, kBorder>(batch, &g.planes[p], sum)
                      : add_by_weight<3, false, kBorder>(batch, &g.planes[p], sum);
  }
  float* const sum = sums.variance();
  if (g.variance) add_by_weight<1, true, kBorder>(batch, &g.variance, &sum);
}

inline void start_sums(const Gather& g, const quell_run& run, Sums& sums) {
  const V c = all(g.taps.centre);
  for (int i = 0; i < run.n; i += kLanes) {
    for (std::size_t p = 0; p < g.planes.size(); ++p) store(c * load(g.planes[p] + run.at + i), sums.plane(p) + i);
    store(c, sums.weight() + i);
    if (g.variance) store(c * c * load(g.variance + run.at + i), sums.variance() + i);
  }
}
inline void store_means(const Gather& g, int n, Sums& sums, const Means& to) {
  for (int i = 0; i < n; i += kLanes) {
    const V inverse = all(1.0f) / load(sums.weight() + i);
    for (std::size_t p = 0; p < g.planes.size(); ++p)
      store(load(sums.plane(p) + i) * inverse, to.plane[p] + to.at + i, n - i);
    if (g.variance) store(load(sums.variance() + i) * (inverse * inverse), to.variance + to.at + i, n - i);
  }
}

template <bool kBorder>
void add_batch(const Gather& g, const Batch& batch, Sums& sums) {
  const std::size_t planes = g.planes.size();
  if (planes == 3 || (planes == 1 && !g.variance)) {
    Target target{{}, g.variance, {}, sums.weight(), sums.variance(), {}, nullptr};
    for (std::size_t p = 0; p < planes; ++p) target.plane[p] = g.planes[p], target.sum[p] = sums.plane(p);
    if (const Means* to = batch.means) {
      for (std::size_t p = 0; p < planes; ++p) target.mean[p] = to->plane[p] + to->at;
      if (g.variance) target.mean_variance = to->variance + to->at;
    }
    const float c = g.taps.centre;
    planes == 1  ? add_by_exponent<1, false, kBorder>(batch, c, target)
    : g.variance ? add_by_exponent<3, true, kBorder>(batch, c, target)
                 : add_by_exponent<3, false, kBorder>(batch, c, target);
  } else {
    if (batch.first) start_sums(g, batch.run, sums);
    weights_in_place(batch, sums.weight());
    add_planes_by_weight<kBorder>(g, batch, sums);
    if (batch.means) store_means(g, batch.run.n, sums, *batch.means);
  }
}

// Zero where a tap of the run lies in the image, +inf where it does not: adding to +inf cannot bring it back.
inline void fence(const quell_run& run, int width, float* exponent) {
  for (int t = 0; t < run.taps; ++t) {
    const int first = -run.x - run.tap[t].dx, last = first + width;  // lanes whose tap is in the image
    const V from = all(float(first)), to = all(float(last));
    float* e = exponent + t * run.row;
    for (int i = 0; i < run.n; i += kLanes) {
      const V lane = lane_numbers() + all(float(i));
      store(hn::IfThenElse(hn::And(lane >= from, lane < to), zero(), all(HUGE_VALF)), e + i);
    }
  }
}

// Segment (x … x + n - 1, y), n <= QUELL_SEGMENT: leaves sums, written up to n rounded up to a vector, or stores means.
inline void gather(const Gather& g, int x, int y, int n, Sums& sums, const Means* means = nullptr) {
  alignas(64) float exponent[QUELL_MAX_TAPS * kExponentRow];
  const std::ptrdiff_t at = y * g.pitch + x;
  const bool rows_inside = y >= g.taps.reach_y && y + g.taps.reach_y < g.height;
  const bool border = x < g.taps.reach_x || x + n + g.taps.reach_x > g.width;
  quell_tap inside[QUELL_MAX_TAPS];
  float inside_kernel[QUELL_MAX_TAPS];
  const int count = int(g.taps.tap.size());
  for (int first = 0; first < count || first == 0; first += QUELL_MAX_TAPS) {
    const bool last = first + QUELL_MAX_TAPS >= count;
    const quell_tap* tap = g.taps.tap.data() + first;
    Batch batch{{x, y, n, last ? count - first : QUELL_MAX_TAPS, tap, at, kExponentRow, 1, 0},
                g.taps.log2_kernel.data() + first,
                exponent,
                first == 0,
                last ? means : nullptr};
    quell_run& run = batch.run;
    if (!rows_inside) {
      int kept = 0;
      for (int t = 0; t < run.taps; ++t) {
        if (y + tap[t].dy < 0 || y + tap[t].dy >= g.height) continue;
        inside[kept] = tap[t];
        inside_kernel[kept++] = batch.log2_kernel[t];
      }
      if (kept < run.taps) run.paired = 0;
      run.taps = kept, run.tap = inside, batch.log2_kernel = inside_kernel;
    }
    const bool fenced = border || g.weights.empty();
    if (fenced) fence(run, g.width, exponent);
    run.store = !fenced;
    if (run.taps > 0)
      for (const quell_bound_weight& w : g.weights) {
        w.weigh(w.instance, w.resource, w.in, &run, exponent);
        run.store = 0;
      }
    border ? add_batch<true>(g, batch, sums) : add_batch<false>(g, batch, sums);
  }
}

// Rows of a tile in segments; with step > 1 the rows of one residue class after another, for they share most of what
// they read. Within `border` pixels of the image's sides segments are cut short, so that little goes the way of
// borders.
template <class Visit>
HWY_INLINE void for_each_segment(const quell_tile& tile, int step, int border, int width, Visit visit) {
  const int left = (border + 31) / 32 * 32, right = width - border;
  for (int residue = 0; residue < step; ++residue)
    for (int y = tile.y0 + residue; y < tile.y1; y += step)
      for (int x = tile.x0, end; x < tile.x1; x = end) {
        end = x + QUELL_SEGMENT;
        if (x < left && left < end) end = left;
        if (right < end && right - x >= 32) end = x + (right - x) / 32 * 32;
        if (end > tile.x1) end = tile.x1;
        visit(x, y, end - x);
      }
}

// A whole filter: the weighted means of a tile. `variance` is where their variance goes, or null.
inline void gather_tile(const Gather& g, const quell_tile& tile, int step, const quell_image& out, float* variance) {
  Sums sums(g.planes.size());
  for_each_segment(tile, step, g.taps.reach_x, g.width, [&](int x, int y, int n) HWY_ATTR {
    const Means means{out.plane, variance, y * out.pitch + x};
    gather(g, x, y, n, sums, &means);
  });
}

QUELL_SIMD_END
#endif
