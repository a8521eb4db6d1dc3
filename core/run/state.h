// The delayed buffers of a run as a file: all the state that there is.
#pragma once

#include "core/run/session.h"

#include <cstdint>
#include <filesystem>

namespace quell {

// Writes the history that the frame after `frame` will read, to a temporary name that is then renamed. Throws
// Error(Exit::resources).
void save_state(const std::filesystem::path&, const Graph&, const Session&, std::int64_t frame);

// Fills a fresh session's history and gives the frame after which it was saved. Throws Error(Exit::input) for a file
// that is missing, damaged or of another graph or size.
std::int64_t load_state(const std::filesystem::path&, const Graph&, Session&);

}  // namespace quell
