// Keeps a filter on one object.
#include "id_weight/id_weight_kernels.h"

#include <quell/node.h>

namespace {

struct IdWeight {
  quell::In<quell::Id> id;
  quell::Out<quell::Weight> weight;

  void describe(quell::Describe& d) {
    d.summary("Shuts out neighbours of another object.");
    d.source(
        "GAMES202 lecture 13 and Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, which test mesh ids.");
    d.in(id, "id", "Object or material numbers; a miss, 0xFFFFFFFF, is like other misses only.");
    d.out(weight, "weight", "1 where the numbers are equal, else 0. Numbers have no distance, so nothing falls off.");
  }

  void weigh(const quell_input* in, const quell_run& run, float* exponent) const {
    quell::id_weigh(run, quell::plane(in, id, 0), exponent);
  }
};

}  // namespace
QUELL_PLUGIN("id_weight", IdWeight)
