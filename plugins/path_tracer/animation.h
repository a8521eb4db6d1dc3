// Keyframed values that are defined at any real time, so that the frame before the first one exists too.
#pragma once

#include "path_tracer/math.h"

#include <array>
#include <vector>

namespace path_tracer {

enum class Ease {
  step,  // holds each key until the next
  linear,
  smooth  // cubic with continuous velocity (Catmull-Rom for uneven times)
};

// Keys are in order of time. Before the first and after the last the value is held, unless `loop` > 0: then time wraps,
// the keys span [0, loop], and a value that has grown over a loop (a full turn) goes on growing in velocity, not in
// place.
template <int N>
struct Track {
  using Value = std::array<double, N>;

  std::vector<double> at;
  std::vector<Value> value;
  Ease ease = Ease::linear;
  double loop = 0;

  bool moves() const { return at.size() > 1; }
  Value sample(double time) const;

 private:
  Value velocity(std::size_t key) const;
};

extern template struct Track<1>;
extern template struct Track<7>;

// A similarity: scale, then rotate about x, then y, then z (degrees), then translate. Uniform scale keeps spheres round
// and normals perpendicular.
struct Pose {
  Vec translate{0};
  Vec rotate{0};
  double scale = 1;

  Mat matrix() const;
};

struct PoseTrack : Track<7> {
  Pose pose(double time) const;
};

}  // namespace path_tracer
