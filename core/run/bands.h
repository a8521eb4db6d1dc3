// The memory of bands: where a thread keeps the values that live within a chain, and nodes bound to it.
#pragma once

#include "core/image/image.h"
#include "core/run/plan.h"

#include <cstddef>
#include <vector>

namespace quell {

// A node's inputs and outputs, as it is given them.
struct Bound {
  std::vector<std::vector<quell_image>> images;
  std::vector<std::vector<quell_bound_weight>> weights;
  std::vector<quell_input> in;
  std::vector<quell_image> out;
};

// One thread's.
class Band {
 public:
  void prepare(const Plan&);

  std::vector<Bound> bound;     // by node
  std::vector<double> seconds;  // that the nodes of the current chain have taken

  // A local value; it shows the rows that aim() says, and keeps its address.
  quell_image image(std::size_t value) const;
  // Turns the local values of a chain to rows [y0, y0 + rows).
  void aim(const Chain&, int y0, int rows);

 private:
  const Plan* plan_ = nullptr;
  Image memory_;
  std::vector<std::vector<float*>> planes_;  // by value
};

}  // namespace quell
