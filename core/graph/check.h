// Types of wires, and inputs that must be connected.
#pragma once

#include "core/graph/resolve.h"

namespace quell {

// Binds the type variables of nodes with ports of type any: out_types of all nodes are known afterwards, or 0 where
// nothing tells them.
void infer_types(Net&);

// Every link of a flat net joins equal types, every required input is connected. Wires of swapped nodes that do not fit
// their new type go, and fill_swapped() has a second try.
void check(Net&, const std::optional<Roles>&, Faults&);

}  // namespace quell
