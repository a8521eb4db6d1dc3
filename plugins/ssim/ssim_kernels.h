// Structural similarity along rows.
#pragma once

namespace quell {

// The window is 11×11.
inline constexpr int kSsimRadius = 5, kSsimTaps = 2 * kSsimRadius + 1;

// One channel of a row of pixels.
struct SsimRow {
  const float *image[kSsimTaps], *reference[kSsimTaps];  // rows around it, at pixel x = 0, those outside clamped
  const double* weight;                                  // kSsimTaps of them, their sum 1
  int width, x0, x1;
  double share;  // of this channel in the mean over channels
  bool first;    // of the channels: what is in the outputs is overwritten, not added to
};

// Room that a row wants, doubles.
int ssim_scratch(int x0, int x1);

// Adds share · l · cs to `similarity` and share · cs to `contrast`, rows at pixel x = 0.
void ssim_row(const SsimRow&, double* scratch, float* similarity, float* contrast);

}  // namespace quell
