// Which nodes run together, band by band, so that what one makes is still in the cache when the next reads it.
#pragma once

#include <cstddef>
#include <vector>

namespace quell {

class Plan;

// Nodes [first, end) of the order, weight nodes among them. All that they read of each other they read at their own
// rows; and all of their images have one size.
struct Chain {
  std::size_t first = 0, end = 0;
  std::size_t runs = 0;    // nodes that are not weights
  std::size_t planes = 0;  // that a band of the values needs which live within the chain
};

// Every node is in one of them. Shapes and reach have been planned.
std::vector<Chain> chains_of(const Plan&);

}  // namespace quell
