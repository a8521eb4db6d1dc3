// How far pictures are from a reference, and how much they flicker, where the reference is noisy itself: two
// independent takes of it, A and B, so that the noise of each cancels.
#pragma once

#include "core/image/image.h"

namespace quell::test {

struct Reference {
  const Image &a, &b;
};

// -10 log10 mean (T(X) - T(A)) (T(X) - T(B)) with T(x) = x / (1 + x).
double psnr(const Image& x, Reference);

// mean (X - A)(X - B) / (R² + 0.01), R the mean of A and B.
double relative_error(const Image& x, Reference);

// sum X / sum R - 1: light that was lost or made up.
double brightness_error(const Image& x, Reference);

// mean |T(X) - T(X before)| · 1000 along motion, X before interpolated between four pixels, where all four show the
// object that X shows.
double flicker(const Image& x, const Image& before, const Image& motion, const Image& id, const Image& id_before);

}  // namespace quell::test
