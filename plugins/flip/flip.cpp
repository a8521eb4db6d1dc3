// FLIP: what an eye sees that flips between an image and its reference.
#include <quell/node.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "flip/flip_filters.h"
#include "flip/flip_kernels.h"

namespace {

using quell::FlipExposure;
using quell::FlipFilters;
using quell::FlipSeen;

// Where the ACES curve reaches 0.85: the brightest pixel of the first exposure and the median of the last come to it.
constexpr double kBright = 2.1188724;
// A median that is darker than this share of the brightest pixel, as one of black is, counts as it: 20 stops of
// exposures are enough.
constexpr double kDarkest = 1.0 / (1 << 20);
// Output rows that are worked on at once, so that what is between the passes stays in the cache.
constexpr int kRows = 32;
// Vectors are read and written past the last pixel.
constexpr int kPast = 16;

// One image of a stretch of rows, filtered along them and then down.
class Filtered {
 public:
  Filtered(const FlipFilters& filters, int columns)
      : f_(filters), columns_(columns), stride_(columns + 2 * filters.radius + kPast) {
    const std::size_t rows = std::size_t(kRows + 2 * f_.radius);
    opponent_.resize(std::size_t(3 * stride_));
    for (auto& p : along_) p.resize(rows * std::size_t(stride_));
    for (auto& p : down_) p.resize(std::size_t(stride_));
    for (auto& p : seen_) p.resize(std::size_t(stride_));
  }

  // Rows y0 − radius to y1 + radius, columns from x0; beyond the border its pixels are repeated.
  void along(const quell_image& image, FlipExposure exposure, int x0, int y0, int y1) {
    const int r = f_.radius, taps = 2 * r + 1, left = x0 - r, right = x0 + columns_ + r;
    const int from = std::max(left, 0), to = std::min(right, image.width);
    for (int y = y0 - r; y < y1 + r; ++y) {
      const std::ptrdiff_t row = std::clamp(y, 0, image.height - 1) * image.pitch;
      const float* const rgb[3] = {image.plane[0] + row, image.plane[1] + row, image.plane[2] + row};
      float* const start[3] = {opponent(0), opponent(1), opponent(2)};
      float* const seen[3] = {start[0] + from - left, start[1] + from - left, start[2] + from - left};
      quell::flip_opponent(f_, exposure, rgb, from, to, seen);
      for (float* const p : start) {
        std::fill(p, p + (from - left), p[from - left]);
        std::fill(p + (to - left), p + (right - left), p[to - left - 1]);
      }
      const std::vector<float>* const weights[kAlong] = {
          &f_.lightness, &f_.red_green, &f_.blue_yellow[0], &f_.blue_yellow[1], &f_.gauss, &f_.edge, &f_.point};
      static constexpr int kOf[kAlong] = {0, 1, 2, 2, 0, 0, 0};
      for (int i = 0; i < kAlong; ++i)
        quell::flip_along(opponent(kOf[i]), weights[i]->data(), taps, columns_, row_of(i, y - (y0 - r)));
    }
  }

  // Row `y` of the stretch, counted from its first.
  FlipSeen down(int y) {
    const auto filter = [&](int to, int from, const std::vector<float>& weight, bool add = false) {
      quell::flip_down(row_of(from, y), stride_, weight.data(), 2 * f_.radius + 1, columns_, down_[to].data(), add);
    };
    filter(0, kLightness, f_.lightness);
    filter(1, kRedGreen, f_.red_green);
    filter(2, kBlueYellow0, f_.blue_yellow_column[0]);
    filter(2, kBlueYellow1, f_.blue_yellow_column[1], true);
    filter(3, kEdge, f_.gauss);
    filter(4, kGauss, f_.edge);
    filter(5, kPoint, f_.gauss);
    filter(6, kGauss, f_.point);
    const FlipSeen seen{seen_[0].data(), seen_[1].data(), seen_[2].data(), seen_[3].data(), seen_[4].data()};
    quell::flip_seen(f_,
                     {down_[0].data(), down_[1].data(), down_[2].data(), down_[3].data(), down_[4].data(),
                      down_[5].data(), down_[6].data()},
                     columns_, seen);
    return seen;
  }

 private:
  enum { kLightness, kRedGreen, kBlueYellow0, kBlueYellow1, kGauss, kEdge, kPoint, kAlong };
  float* opponent(int i) { return opponent_.data() + i * stride_; }
  float* row_of(int plane, int y) { return along_[plane].data() + y * stride_; }

  const FlipFilters& f_;
  int columns_;
  std::ptrdiff_t stride_;
  std::vector<float> opponent_, along_[kAlong], down_[7], seen_[5];
};

struct Flip {
  quell::In<quell::Radiance> image, reference;
  quell::In<quell::Value> brightest, median;
  quell::Out<quell::Scalar> map;
  float pixels_per_degree = 67.020645f;

  void describe(quell::Describe& d) {
    d.summary("Predicts how different an image looks from its reference when the two are flipped between.");
    d.source(
        "Andersson et al. 2020, FLIP: A Difference Evaluator for Alternating Images; Andersson et al. 2021, "
        "Visualizing Errors in Rendered High Dynamic Range Images (HDR-FLIP).");
    const int radius = quell::flip_radius(double(pixels_per_degree));
    d.in(image, "image", "Linear radiance, clamped to [0,1]: expose it first. With brightest and median, any.")
        .halo(radius);
    d.in(reference, "reference", "Linear radiance, exposed alike.").halo(radius);
    d.in(brightest, "brightest",
         "Largest luminance of the reference, as percentile gives it. With both, this is HDR-FLIP: the largest error "
         "of "
         "all exposures from the one that brings this to 0.85 on the ACES curve to the one that brings the median "
         "there, about a stop apart.")
        .optional()
        .anywhere();
    d.in(median, "median", "Median luminance of the reference; held above a millionth (2^-20) of the brightest.")
        .optional()
        .anywhere();
    d.out(map, "map", "0 where no difference is seen, to 1.");
    d.param(
         pixels_per_degree, "pixels_per_degree",
         "Pixels that the eye sees within a degree: distance · pixels / width · π / 180. The default is a display of "
         "3840 pixels and 0.7 m, 0.7 m away.")
        .range(1, 500);
  }

  void shapes(const quell_spec& spec, quell_shape* out) const {
    if ((spec.in_count[brightest.index] > 0) != (spec.in_count[median.index] > 0))
      throw std::runtime_error("brightest and median go together: one is connected and the other is not");
    out[map.index] = {spec.in[image.index].width, spec.in[image.index].height, 1};
  }

  FlipFilters prepare(const quell_spec&) const { return quell::flip_filters(double(pixels_per_degree)); }

  void run(const quell::Tile& tile, const FlipFilters& filters) const {
    const auto exposures = exposures_of(tile);
    const int columns = tile.x1 - tile.x0;
    Filtered a(filters, columns), b(filters, columns);
    for (int y0 = tile.y0; y0 < tile.y1; y0 += kRows) {
      const int y1 = std::min(y0 + kRows, tile.y1);
      for (std::size_t e = 0; e < exposures.size(); ++e) {
        a.along(tile[image], exposures[e], tile.x0, y0, y1);
        b.along(tile[reference], exposures[e], tile.x0, y0, y1);
        for (int y = y0; y < y1; ++y)
          quell::flip_error(a.down(y - y0), b.down(y - y0), columns, tile.row(map, 0, y) + tile.x0, e == 0);
      }
    }
  }

 private:
  std::vector<FlipExposure> exposures_of(const quell::Tile& tile) const {
    if (!tile.has(brightest)) return {FlipExposure{}};
    const double most = *tile.row(brightest, 0, 0);
    if (!(most > 0)) return {FlipExposure{1, true}};
    const double middle = std::clamp(double(*tile.row(median, 0, 0)), kDarkest* most, most);
    const double start = std::log2(kBright / most), stop = std::log2(kBright / middle);
    const int steps = std::max(2, int(std::ceil(stop - start)));
    std::vector<FlipExposure> list;
    for (int i = 0; i < steps; ++i) list.push_back({float(std::exp2(start + (stop - start) * i / (steps - 1))), true});
    return list;
  }
};

}  // namespace
QUELL_PLUGIN("flip", Flip)
