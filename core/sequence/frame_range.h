// Frame numbers as people write them: "0-19", "1-10x2", "1-10y2", "1,2,5-10", "20-10", "-3--1".
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace quell {

// The numbers in the order given; both ends of a range belong to it. "x2" takes every second, "y2" what "x2" leaves
// out, and
// ":2" is another spelling of "x2". Nothing is returned, and `problem` says why, when the text is no range, names a
// frame twice or more than ten million frames.
std::optional<std::vector<std::int64_t>> parse_frame_range(std::string_view text, std::string& problem);

// The shortest usual spelling: "1-4,7".
std::string frame_range_text(std::span<const std::int64_t> frames);

}  // namespace quell
