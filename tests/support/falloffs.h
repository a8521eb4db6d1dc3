// The falloffs of <quell/falloff.h> in double precision, by name.
#pragma once

#include <string>
#include <vector>

namespace quell::test {

const std::vector<std::string>& falloff_names();

// Weight at x = distance / sigma >= 0.
double falloff(const std::string& name, double x);

}  // namespace quell::test
