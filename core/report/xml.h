// Text as XML holds it.
#pragma once

#include <string>

namespace quell {

// For elements and for attributes in double quotes. What XML 1.0 cannot hold at all, control characters, becomes '?'.
std::string xml_text(const std::string& text);

}  // namespace quell
