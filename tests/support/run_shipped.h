// Runs a graph that ships with the product over real frames.
#pragma once

#include "core/graph/load.h"
#include "core/sequence/frame_source.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace quell::test {

// Outputs of a frame, by name; taps by theirs.
using FrameOutputs = std::map<std::string, quell_image>;

// The graph of this name in graphs/, with edits, for a source that provides `roles` (nullptr: all). Throws what it
// reports.
Graph shipped_graph(const std::string& name, std::vector<Edit> edits = {},
                    const std::map<std::string, int>* roles = nullptr);

// Calls `use` for every frame of the source.
void run_shipped(const std::string& name, std::vector<Edit> edits, FrameSource& source,
                 const std::function<void(std::int64_t frame, const FrameOutputs&)>& use);

}  // namespace quell::test
