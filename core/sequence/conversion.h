// From what a renderer wrote to the conventions of <quell/types.h>: a closed list of conversions, then repairs.
#pragma once

#include "core/sequence/color_encoding.h"
#include "core/sequence/frame_source.h"
#include "core/sequence/image_file.h"
#include "core/sequence/matrices.h"

#include <quell/abi.h>

#include <optional>
#include <vector>

namespace quell {

// Applied in this order; what is off or empty is left out.
struct Conversion {
  std::optional<float> miss;    // the file's value where nothing was hit
  bool miss_is_camera = false;  // position: the camera's own position where nothing was hit
  ColorEncoding light;          // encoded colours to linear ones
  bool encoded = false;         // [0,1] to [-1,1]
  bool negate = false;
  std::vector<float> scale;    // one factor, or one a channel
  bool scale_by_size = false;  // x by the width and y by the height: fractions of the image to pixels
  bool flip_y = false;         // negates the second channel
  bool reciprocal = false;     // 1/z to z
  bool distance = false;       // distance along the ray to depth along the view axis; needs the camera
  bool from_camera = false;    // view space to world space; needs the camera

  bool needs_camera() const { return miss_is_camera || distance || from_camera; }
};

// A pixel that was not finite.
struct BrokenPixel {
  int x = 0, y = 0, channel = 0;
  float value = 0;
};

// Converts the pixels of `window` in place, fills the others with the type's missing value and repairs what is not
// allowed: radiance and albedo become 0 where any channel is NaN, 65504 where infinite and 0 where negative; of other
// types a pixel that holds something not finite becomes a miss. Depth is kFar where the file has 0, at least 1e10 or no
// finite number; normals get length 1. The camera may be null when the conversion needs none. Says which pixel was the
// first, row by row, that was not finite; of depth, NaN.
std::optional<BrokenPixel> convert(const quell_image& image, int type, const Window& window, const Conversion&,
                                   const FrameMatrices* camera, Repairs& repairs);

}  // namespace quell
