// One plan at work: buffers bound to nodes, frame by frame.
#pragma once

#include "core/run/bands.h"
#include "core/run/buffers.h"
#include "core/run/executor.h"
#include "core/run/plan.h"
#include "core/run/workers.h"

#include <cstdint>
#include <span>
#include <vector>

namespace quell {

class Session {
 public:
  Session(const Graph&, std::vector<quell_shape> inputs, Workers&, const RunOptions&);

  const Plan& plan() const { return plan_; }
  const std::vector<quell_shape>& input_shapes() const { return input_shapes_; }

  // Images of the graph's inputs for the frame `ahead` frames after the current one: where a reader fills them.
  std::vector<quell_image> inputs(int ahead) const;
  // Filters the current frame. Its inputs have been filled. Gives the wall time of each node, seconds.
  void filter(std::int64_t frame, std::span<double> times);
  // What all threads together spent on a node when the current frame was filtered, seconds.
  double busy(std::size_t node) const;
  // Images of the graph's outputs for the current frame.
  std::vector<quell_image> outputs() const;
  // On to the next frame.
  void advance();
  // From here on there is no past. Nothing may be reading outputs.
  void forget();

  // How many frames of history there are; and the same with images filled by the caller.
  std::int64_t age() const { return age_; }
  void set_age(std::int64_t age) { age_ = age; }
  // A value `delay` frames before the current one.
  quell_image history(std::size_t value, int delay) const { return buffers_.image(value, ordinal_, delay); }

 private:
  void bind(const Chain&, std::size_t node, Band&);
  quell_image wire_image(const Wire&, const Band&) const;
  quell_image value_image(std::size_t value, int delay, const Band&) const;
  void run_rows(const Chain&, const Band& bound, std::vector<double>& seconds, const quell_tile& rows);
  // Shares the time of a chain out to its nodes as the threads spent theirs.
  void share_out(const Chain&, double wall, std::span<double> times) const;

  const Graph* graph_;
  std::vector<quell_shape> input_shapes_;
  Plan plan_;
  Buffers buffers_;
  Resources resources_;
  Workers* workers_;
  int wanted_rows_;
  Trace* trace_;
  TapCounter* taps_;
  std::vector<Band> bands_;  // by thread; the first also holds what all threads share
  std::int64_t ordinal_ = 0, age_ = 0;
};

}  // namespace quell
