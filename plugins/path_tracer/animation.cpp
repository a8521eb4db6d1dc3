// Interpolation of keyframes.
#include "path_tracer/animation.h"

#include <glm/gtc/matrix_transform.hpp>

namespace path_tracer {

namespace {

template <std::size_t N>
std::array<double, N> combine(const std::array<double, N>& a, double s, const std::array<double, N>& b, double t) {
  std::array<double, N> sum;
  for (std::size_t i = 0; i < N; ++i) sum[i] = a[i] * s + b[i] * t;
  return sum;
}

}  // namespace

template <int N>
auto Track<N>::velocity(std::size_t key) const -> Value {
  const std::size_t last = at.size() - 1;
  std::size_t before = key ? key - 1 : 0, after = std::min(key + 1, last);
  double then = at[before], next = at[after];
  Value from = value[before], to = value[after];
  if (loop > 0 && (key == 0 || key == last)) {
    const Value growth = combine(value[last], 1, value[0], -1);
    from = combine(value[last - 1], 1, growth, -1), then = at[last - 1] - loop;
    to = value[1], next = at[1];
  }
  return combine(to, 1 / (next - then), from, -1 / (next - then));
}

template <int N>
auto Track<N>::sample(double time) const -> Value {
  if (loop > 0) time -= loop * std::floor(time / loop);
  if (!moves() || time <= at.front()) return value.front();
  if (time >= at.back()) return value.back();
  const std::size_t k = std::size_t(std::upper_bound(at.begin(), at.end(), time) - at.begin()) - 1;
  if (ease == Ease::step) return value[k];
  const double length = at[k + 1] - at[k], u = (time - at[k]) / length;
  if (ease == Ease::linear) return combine(value[k], 1 - u, value[k + 1], u);
  // Cubic Hermite basis.
  const double s = u * u * (3 - 2 * u);
  const Value ends = combine(value[k], 1 - s, value[k + 1], s);
  const Value slopes = combine(velocity(k), length * u * (1 - u) * (1 - u), velocity(k + 1), -length * u * u * (1 - u));
  return combine(ends, 1, slopes, 1);
}

template struct Track<1>;
template struct Track<7>;

Mat Pose::matrix() const {
  Mat m = glm::translate(Mat(1), translate);
  m = glm::rotate(m, glm::radians(rotate.z), Vec(0, 0, 1));
  m = glm::rotate(m, glm::radians(rotate.y), Vec(0, 1, 0));
  m = glm::rotate(m, glm::radians(rotate.x), Vec(1, 0, 0));
  return glm::scale(m, Vec(scale));
}

Pose PoseTrack::pose(double time) const {
  const Value v = sample(time);
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6]};
}

}  // namespace path_tracer
