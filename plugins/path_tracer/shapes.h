// The surfaces that scenes are made of, and where lines meet them.
#pragma once

#include "path_tracer/math.h"

#include <variant>

namespace path_tracer {

// Outward is u × v, and counter-clockwise for triangles.
struct Quad {
  Vec corner, u, v;
};
struct Triangle {
  Vec a, b, c;
  glm::dvec2 texture_a, texture_b, texture_c;
};
struct Sphere {
  Vec center;
  double radius;
};
// The side of a cone frustum (a cylinder where both radii are equal), open at both ends. Outward is away from the axis.
struct Frustum {
  Vec from, to;
  double radius_from, radius_to;
};
struct Disk {
  Vec center, normal;
  double radius;
};
using Shape = std::variant<Quad, Triangle, Sphere, Frustum, Disk>;

struct Ray {
  Vec origin, direction;  // direction of any length
};

struct Bounds {
  Vec low, high;
};

struct SurfacePoint {
  double t;  // along the ray, in lengths of its direction
  Vec position;
  Vec normal;          // unit, outward
  glm::dvec2 texture;  // lengths along the surface
};

Shape transformed(const Shape&, const Mat& similarity, double scale);
Bounds bounds(const Shape&);
// First t in (near, far) at which the ray meets a sphere, frustum or disk; negative if none.
double crossing(const Shape&, const Ray&, double near, double far);
// All that is known of the point near `t`, in double precision where `t` comes from a single-precision traversal.
SurfacePoint locate(const Shape&, const Ray&, double t);

// The whole area, for surfaces that emit.
double area(const Shape&);
// A point of the surface that stands for all of it.
Vec middle(const Shape&);
// Outward normal of a flat surface.
Vec flat_normal(const Shape&);

template <class... F>
struct Overload : F... {
  using F::operator()...;
};

}  // namespace path_tracer
