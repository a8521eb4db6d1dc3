// Turns the JSON library's parse errors into messages that say what stands there and what was expected.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace quell {

struct SyntaxError {
  std::size_t offset;  // of the offending token
  std::string text, note;
};

// `last_end` is where the last good token ends, `opened` whether that was [ or {, and `what` the library's message.
SyntaxError rephrase_syntax_error(std::string_view text, std::size_t last_end, bool opened, std::string_view what);

}  // namespace quell
