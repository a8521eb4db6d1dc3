// A thread's memory of bands.
#include "core/run/bands.h"

#include <algorithm>

namespace quell {

void Band::prepare(const Plan& plan) {
  plan_ = &plan;
  bound.resize(plan.nodes().size());
  seconds.resize(plan.nodes().size());
  planes_.resize(plan.values().size());
  for (std::size_t i = 0; i < planes_.size(); ++i)
    if (const auto& v = plan.values()[i]; v.local) planes_[i].resize(std::size_t(v.shape.channels));
}

quell_image Band::image(std::size_t value) const {
  const auto& s = plan_->values()[value].shape;
  return {planes_[value].data(), s.width, s.height, s.channels, 0, pitch_for(s.width)};
}

void Band::aim(const Chain& chain, int y0, int rows) {
  for (std::size_t n = chain.first; n < chain.end; ++n)
    for (std::size_t o = 0; o < plan_->graph().nodes[n].type().outputs().size(); ++o) {
      const auto i = plan_->value_of({int(n), int(o)});
      const auto& v = plan_->values()[i];
      if (!v.exists || !v.local) continue;
      if (memory_.width() != v.shape.width || memory_.height() < rows || memory_.channels() < int(chain.planes))
        memory_ =
            Image(v.shape.width, std::max(rows, memory_.height()), std::max(int(chain.planes), memory_.channels()));
      // As if the rows before and after were there.
      for (std::size_t c = 0; c < planes_[i].size(); ++c)
        planes_[i][c] = memory_.row(int(v.offset + c), 0) - y0 * memory_.pitch();
    }
}

}  // namespace quell
