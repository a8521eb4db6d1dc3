// The reference of a sequence that has two halves of it: their mean.
#pragma once

#include "core/sequence/frame_source.h"

#include <memory>
#include <string_view>

namespace quell {

// Roles of what judges: the whole of a reference, or two halves that know nothing of each other.
inline constexpr std::string_view kReference = "reference";
inline constexpr std::string_view kReferenceHalves[] = {"reference_a", "reference_b"};

inline bool is_reference(std::string_view role) {
  return role == kReference || role == kReferenceHalves[0] || role == kReferenceHalves[1];
}

// Gives all that `source` gives, and `reference`, the mean of its reference_a and reference_b, where it has these and
// not that.
std::unique_ptr<FrameSource> with_mean_of_halves(std::unique_ptr<FrameSource> source);

}  // namespace quell
