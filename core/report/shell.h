// Commands as a shell takes them.
#pragma once

#include <span>
#include <string>

namespace quell {

// Words with spaces between, quoted where the shell would read them as more than themselves.
std::string shell_text(std::span<const std::string> words);

}  // namespace quell
