// The rules that every node keeps, each as a function that says how a use breaks it, or "".
#pragma once

#include "tests/contract/use.h"

#include <string>

namespace quell::test {

// Run over the whole image: every pixel is written, nothing else is, and all numbers are finite.
std::string breaks_when_run(const Use&);
// Cut into tiles of rows × columns, each run alone with every input pixel beyond the declared reach set to NaN: each
// tile writes its pixels and no others, with the bits of the whole image. Rows or columns of 0: all.
std::string breaks_in_tiles(const Use&, int rows, int columns);
// Tiles run by several threads at once, and run again: the bits of the whole image.
std::string breaks_in_threads(const Use&, int threads);
// With one number of one input NaN or infinite: nothing farther than the declared reach changes.
std::string breaks_on_non_finite(const Use&);
// For weight nodes: exponents of typical runs are >= 0 and lie where they should; the same bits however a row is cut
// into runs, with every input row beyond the declared reach set to NaN; stored and added exponents agree.
std::string breaks_when_weighing(const Use&);

}  // namespace quell::test
