// The numbers of the path tracer: geometry in double, colour and scattering in float.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace path_tracer {

using Vec = glm::dvec3;  // points and directions in space
using Dir = glm::vec3;   // directions in a shading frame, z = normal
using Rgb = glm::vec3;   // linear colour
using Mat = glm::dmat4;  // affine maps for column vectors

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr double kPiExact = 3.14159265358979323846;

inline float luminance(const Rgb& c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }
inline float largest(const Rgb& c) { return std::max({c.r, c.g, c.b}); }
inline Vec point(const Mat& m, const Vec& p) { return Vec(m * glm::dvec4(p, 1)); }
inline Vec direction(const Mat& m, const Vec& d) { return Vec(m * glm::dvec4(d, 0)); }

// An orthonormal frame about a unit normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3).
struct Frame {
  explicit Frame(const Vec& normal) : n(normal) {
    const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    s = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    t = {b, sign + n.y * n.y * a, -n.y};
  }
  Dir to_local(const Vec& v) const { return {float(glm::dot(v, s)), float(glm::dot(v, t)), float(glm::dot(v, n))}; }
  Vec to_world(const Dir& v) const { return glm::normalize(s * double(v.x) + t * double(v.y) + n * double(v.z)); }

  Vec s, t, n;
};

}  // namespace path_tracer
