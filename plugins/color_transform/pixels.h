// Runs an OpenColorIO processor over a tile of planar images.
#pragma once

#include <OpenColorIO/OpenColorIO.h>
#include <quell/tile.h>

namespace quell::color {

namespace ocio = OCIO_NAMESPACE;

// Immutable, and safe to use on several threads.
class Pixels {
 public:
  explicit Pixels(const ocio::ConstProcessorRcPtr&);
  // The tile's pixels of the first three planes. What comes out below 0 or is no number becomes 0, what lies above
  // `most` becomes that.
  void run(const quell_tile&, const quell_image& in, const quell_image& out, float most) const;

 private:
  ocio::ConstCPUProcessorRcPtr processor_;
};

}  // namespace quell::color
