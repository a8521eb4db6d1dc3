// A plan that keeps within a limit of memory.
#pragma once

#include "core/run/plan.h"

#include <cstddef>
#include <span>
#include <string>

namespace quell {

// The plan with as much of the wanted overlap as `max_memory` bytes (0: no limit) have room for: writing is given up
// before reading, for more images come in than go out, and both where neither is enough. Throws Error(Exit::resources)
// with the largest buffers and the limit that would do when not even one frame at a time fits.
Plan plan_within(const Graph&, std::span<const quell_shape> inputs, Overlap wanted, std::size_t max_memory);

// "617.3 MiB"; less than one in KiB.
std::string size_text(std::size_t bytes);

}  // namespace quell
