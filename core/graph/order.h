// The last stages: what no output needs goes, and the rest comes into an order.
#pragma once

#include "core/graph/check.h"
#include "core/graph/graph.h"

#include <vector>

namespace quell {

// Which nodes an output needs, through delayed wires too. Warns of nodes of the outermost graph that none needs.
std::vector<bool> needed(const Net&, Faults&);

// Indices of the kept nodes, each behind all that it reads undelayed; else as in the file. A cycle is an error that
// prints it.
std::vector<int> order(const Net&, const std::vector<bool>& kept, Faults&);

// The graph of the ordered nodes, with the inputs that they and the outputs read.
Graph assemble(Net&&, const std::vector<int>& order);

}  // namespace quell
