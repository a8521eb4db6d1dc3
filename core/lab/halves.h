// The reference of a sequence that has two halves of it: their mean.
#pragma once

#include "core/sequence/frame_source.h"

#include <memory>

namespace quell {

// Gives all that `source` gives, and `reference`, the mean of its reference_a and reference_b, where it has these and
// not that.
std::unique_ptr<FrameSource> with_mean_of_halves(std::unique_ptr<FrameSource> source);

}  // namespace quell
