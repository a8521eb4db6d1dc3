// Follows aliases, so that every link leads to a node or to an input of the outermost graph.
#pragma once

#include "core/graph/faults.h"
#include "core/graph/net.h"

namespace quell {

// Lists are spliced, delays add up, and links to what is absent go. Aliases become flat too.
void flatten(Net&, Faults&);

// Outputs that exist only with an input that is not connected are absent; links to them go, and so on.
void drop_absent(Net&);

}  // namespace quell
