// Ranges of numbers, walked through evenly or by factors.
#pragma once

#include <string>

namespace quell {

// What keeps two numbers from being the ends of a range of a parameter, which is a float; "" when nothing does.
std::string problem_of_range(double from, double to, bool log);

// What lies `share`, from 0 to 1, of the way between them: of the difference, or with `log` of the factor.
double in_range(double from, double to, bool log, double share);

// To as many digits as are written, so that what is tried is what is written.
double six_digits(double);

}  // namespace quell
