// Synthetic frames changed in ways whose effect on a filter is known: mirrored or brightened, cut or begun later.
#pragma once

#include "core/graph/graph.h"
#include "core/image/image.h"

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

namespace quell::test {

// As a mirror shows it: columns (or rows) change order, motion, slopes and taps follow; vectors of world space stay.
// Taps must be those of a motion that leads to no pixel's centre.
Image mirrored(const Image&, int type, bool horizontal);
// World to screen of a camera whose image, `extent` pixels wide (or high), is mirrored.
Image mirrored_camera(const Image&, bool horizontal, float extent);

// With `scale` times the light: what is measured in radiance is multiplied, moments and variance by their powers.
Image brightened(const Image&, int type, float scale);

struct SyntheticRun {
  int width = 0, height = 0;
  std::int64_t first = 0, last = 0;  // frames; each looks the same in every run
  std::int64_t cut = -1;             // a frame before which history ends
  std::function<Image(const Image&, int type, std::int64_t frame)> alter;
};

// Outputs by frame, in the order of Graph::outputs.
std::map<std::int64_t, std::vector<Image>> run_synthetic(const Graph&, const SyntheticRun&);

}  // namespace quell::test
