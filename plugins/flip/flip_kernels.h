// The steps of FLIP along rows.
#pragma once

#include "flip/flip_filters.h"

#include <cstddef>

namespace quell {

// How radiance comes to [0,1].
struct FlipExposure {
  float gain = 1;
  bool aces = false;  // by the curve of the ACES view; else it is clamped
};

// Pixels x0 to x1 of a row of linear RGB (rows at pixel x = 0) to Y, Cx and Cz, rows at x0.
void flip_opponent(const FlipFilters&, FlipExposure, const float* const rgb[3], int x0, int x1, float* const out[3]);

// out[i] = Σ in[i + k] · weight[k] for i < n; vectors read and write past the last.
void flip_along(const float* in, const float* weight, int taps, int n, float* out);
// out[i] = Σ in[k · stride + i] · weight[k], or that added to out.
void flip_down(const float* in, std::ptrdiff_t stride, const float* weight, int taps, int n, float* out, bool add);

// A row of an image behind the filters: opponent colours, and edges and points along x and y.
struct FlipFiltered {
  const float *lightness, *red_green, *blue_yellow;
  const float *edge_x, *edge_y, *point_x, *point_y;
};
// The same as it is compared: L*, a* and b* as the eye sees them, and how much of an edge and of a point there is.
struct FlipSeen {
  float *l, *a, *b, *edge, *point;
};
void flip_seen(const FlipFilters&, const FlipFiltered&, int n, const FlipSeen& out);
// The error of n pixels, or the larger of that and what is in `out`.
void flip_error(const FlipSeen& image, const FlipSeen& reference, int n, float* out, bool first);

}  // namespace quell
