// Pictures of any tool: colour alone, of which no profile needs to know anything.
#pragma once

#include "core/sequence/sequence.h"

#include <optional>
#include <string>

namespace quell {

// A sequence with one role, `color`, from the channels R G B of a pattern's files, or Y where it is gray. Frames are
// those on the disk, or `range` (--frames); a file without a number is frame 0. Throws Error(Exit::input) when there
// are none and Error(Exit::usage) for a range that is none.
Sequence pictures(const std::string& pattern, const std::optional<std::string>& range);

}  // namespace quell
