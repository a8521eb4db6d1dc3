// What was possible, for messages about a name that is not.
#pragma once

#include <span>
#include <string>

namespace quell::color {

// "it has: a, b and 9 more. Did you mean 'b'?": the names most like `name` first, and the likest offered when few
// letters differ.
std::string listed(const std::string& lead, const std::string& name, std::span<const std::string> names);

}  // namespace quell::color
