// Roles that have a type by convention, and the channel names that a type usually goes by.
#pragma once

#include <quell/abi.h>

#include <string>
#include <string_view>
#include <vector>

namespace quell {

// quell_type of a role: by the table of roles, or because the role is called like the type; 0 when it has none.
int type_of_role(std::string_view role);
// All roles that have a type by convention.
std::vector<std::string> known_roles();
// Names to look for when an input does not name its channels, best first; empty for types without usual names.
std::vector<std::vector<std::string>> usual_channels(int type);

}  // namespace quell
