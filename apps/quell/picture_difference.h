// Two image files, bit by bit.
#pragma once

#include <string>

namespace quell {

// "" when both have the same size and channels and every number of one is that of the other, bit for bit. Else what
// differs: "12 of 2304 pixels, by at most 0.25: …". Throws Error(Exit::input).
std::string picture_difference(const std::string& then, const std::string& now);

}  // namespace quell
