// Short names for long texts: what results, and references that are kept, are filed under.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace quell {

// 64-bit FNV-1a, as 16 hexadecimal digits.
std::string digest(std::string_view text);
// Of a file's content; throws Error(Exit::input) when it cannot be read.
std::string digest_of_file(const std::string& path);

}  // namespace quell
