// Geometry of the surfaces.
#include "path_tracer/shapes.h"

#include <limits>

namespace path_tracer {

namespace {

constexpr double kNone = -1;

// Smaller root of a t² + 2 b t + c = 0 in (near, far) for which `accept` holds, by the form without cancellation.
template <class Accept>
double first_root(double a, double b, double c, double near, double far, Accept&& accept) {
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0)) return kNone;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  double first = a != 0 ? q / a : std::numeric_limits<double>::infinity();
  double second = q != 0 ? c / q : first;
  if (second < first) std::swap(first, second);
  if (first > near && first < far && accept(first)) return first;
  if (second > near && second < far && accept(second)) return second;
  return kNone;
}

double plane(const Ray& ray, const Vec& on, const Vec& normal, double fallback) {
  const double slope = glm::dot(ray.direction, normal);
  return slope != 0 ? glm::dot(on - ray.origin, normal) / slope : fallback;
}

double cross_curved(const Sphere& s, const Ray& ray, double near, double far) {
  const Vec o = ray.origin - s.center;
  // |o|² - r² through the foot of the perpendicular would cancel less, but scenes are a few units across.
  return first_root(glm::dot(ray.direction, ray.direction), glm::dot(o, ray.direction),
                    glm::dot(o, o) - s.radius * s.radius, near, far, [](double) { return true; });
}

double cross_curved(const Frustum& f, const Ray& ray, double near, double far) {
  const double height = glm::length(f.to - f.from), slope = (f.radius_to - f.radius_from) / height;
  const Vec axis = (f.to - f.from) / height, o = ray.origin - f.from;
  const double o_along = glm::dot(o, axis), d_along = glm::dot(ray.direction, axis);
  const Vec o_across = o - axis * o_along, d_across = ray.direction - axis * d_along;
  // |o_across + t d_across| = radius(o_along + t d_along), squared.
  const double r0 = f.radius_from + slope * o_along, r1 = slope * d_along;
  return first_root(glm::dot(d_across, d_across) - r1 * r1, glm::dot(o_across, d_across) - r0 * r1,
                    glm::dot(o_across, o_across) - r0 * r0, near, far, [&](double t) {
                      const double h = o_along + t * d_along;
                      return h >= 0 && h <= height;
                    });
}

double cross_curved(const Disk& d, const Ray& ray, double near, double far) {
  const double t = plane(ray, d.center, d.normal, kNone);
  if (!(t > near && t < far)) return kNone;
  const Vec across = ray.origin + ray.direction * t - d.center;
  return glm::dot(across, across) <= d.radius * d.radius ? t : kNone;
}

glm::dvec2 barycentric(const Triangle& s, const Vec& p) {
  const Vec u = s.b - s.a, v = s.c - s.a, n = glm::cross(u, v), w = p - s.a;
  const double scale = 1 / glm::dot(n, n);
  return {glm::dot(glm::cross(w, v), n) * scale, glm::dot(glm::cross(u, w), n) * scale};
}

SurfacePoint flat_point(const Ray& ray, const Vec& on, const Vec& normal, double t) {
  const double exact = plane(ray, on, normal, t);
  return {exact, ray.origin + ray.direction * exact, normal, {}};
}

// Single precision keeps t to some 1e-7 of itself or of the scene; look for the exact root around it.
double refined(const Shape& shape, const Ray& ray, double t) {
  const double slack = 1e-5 * (1 + t), exact = crossing(shape, ray, t - slack, t + slack);
  return exact == kNone ? t : exact;
}

}  // namespace

Shape transformed(const Shape& shape, const Mat& m, double scale) {
  return std::visit(
      Overload{[&](const Quad& s) -> Shape {
                 return Quad{point(m, s.corner), direction(m, s.u), direction(m, s.v)};
               },
               [&](const Triangle& s) -> Shape {
                 return Triangle{point(m, s.a), point(m, s.b), point(m, s.c), s.texture_a, s.texture_b, s.texture_c};
               },
               [&](const Sphere& s) -> Shape {
                 return Sphere{point(m, s.center), s.radius * scale};
               },
               [&](const Frustum& s) -> Shape {
                 return Frustum{point(m, s.from), point(m, s.to), s.radius_from * scale, s.radius_to * scale};
               },
               [&](const Disk& s) -> Shape {
                 return Disk{point(m, s.center), glm::normalize(direction(m, s.normal)), s.radius * scale};
               }},
      shape);
}

Bounds bounds(const Shape& shape) {
  return std::visit(Overload{[](const Quad& s) -> Bounds {
                               const Vec far = s.corner + s.u + s.v;
                               return {glm::min(glm::min(s.corner, s.corner + s.u), glm::min(s.corner + s.v, far)),
                                       glm::max(glm::max(s.corner, s.corner + s.u), glm::max(s.corner + s.v, far))};
                             },
                             [](const Triangle& s) -> Bounds {
                               return {glm::min(glm::min(s.a, s.b), s.c), glm::max(glm::max(s.a, s.b), s.c)};
                             },
                             [](const Sphere& s) -> Bounds {
                               return {s.center - s.radius, s.center + s.radius};
                             },
                             [](const Frustum& s) -> Bounds {
                               // A disk across unit axis a reaches r·sqrt(1 - a²) along each coordinate.
                               const Vec axis = glm::normalize(s.to - s.from);
                               const Vec reach = glm::sqrt(glm::max(Vec(0), 1.0 - axis * axis));
                               return {glm::min(s.from - reach * s.radius_from, s.to - reach * s.radius_to),
                                       glm::max(s.from + reach * s.radius_from, s.to + reach * s.radius_to)};
                             },
                             [](const Disk& s) -> Bounds {
                               const Vec reach = s.radius * glm::sqrt(glm::max(Vec(0), 1.0 - s.normal * s.normal));
                               return {s.center - reach, s.center + reach};
                             }},
                    shape);
}

double crossing(const Shape& shape, const Ray& ray, double near, double far) {
  return std::visit(Overload{[](const Quad&) { return kNone; }, [](const Triangle&) { return kNone; },
                             [&](const auto& curved) { return cross_curved(curved, ray, near, far); }},
                    shape);
}

SurfacePoint locate(const Shape& shape, const Ray& ray, double t) {
  return std::visit(
      Overload{[&](const Quad& s) {
                 SurfacePoint p = flat_point(ray, s.corner, flat_normal(s), t);
                 const Vec across = p.position - s.corner;
                 p.texture = {glm::dot(across, glm::normalize(s.u)), glm::dot(across, glm::normalize(s.v))};
                 return p;
               },
               [&](const Triangle& s) {
                 SurfacePoint p = flat_point(ray, s.a, flat_normal(s), t);
                 const auto b = barycentric(s, p.position);
                 p.texture = s.texture_a * (1 - b.x - b.y) + s.texture_b * b.x + s.texture_c * b.y;
                 return p;
               },
               [&](const Sphere& s) {
                 SurfacePoint p;
                 p.t = refined(shape, ray, t);
                 p.position = ray.origin + ray.direction * p.t;
                 p.normal = glm::normalize(p.position - s.center);
                 p.texture = s.radius * glm::dvec2(std::atan2(p.normal.z, p.normal.x),
                                                   std::asin(std::clamp(p.normal.y, -1.0, 1.0)));
                 return p;
               },
               [&](const Frustum& s) {
                 SurfacePoint p;
                 p.t = refined(shape, ray, t);
                 p.position = ray.origin + ray.direction * p.t;
                 const double height = glm::length(s.to - s.from);
                 const Frame frame((s.to - s.from) / height);
                 const Vec across = p.position - s.from;
                 const double along = glm::dot(across, frame.n);
                 const Vec radial = glm::normalize(across - frame.n * along);
                 p.normal = glm::normalize(radial - frame.n * ((s.radius_to - s.radius_from) / height));
                 p.texture = {std::atan2(glm::dot(radial, frame.t), glm::dot(radial, frame.s)) *
                                  std::max(s.radius_from, s.radius_to),
                              along};
                 return p;
               },
               [&](const Disk& s) {
                 SurfacePoint p = flat_point(ray, s.center, s.normal, t);
                 const Frame frame(s.normal);
                 p.texture = {glm::dot(p.position - s.center, frame.s), glm::dot(p.position - s.center, frame.t)};
                 return p;
               }},
      shape);
}

double area(const Shape& shape) {
  return std::visit(Overload{[](const Quad& s) { return glm::length(glm::cross(s.u, s.v)); },
                             [](const Triangle& s) { return 0.5 * glm::length(glm::cross(s.b - s.a, s.c - s.a)); },
                             [](const Sphere& s) { return 4 * kPiExact * s.radius * s.radius; },
                             [](const Frustum& s) {
                               return kPiExact * (s.radius_from + s.radius_to) *
                                      std::hypot(glm::length(s.to - s.from), s.radius_to - s.radius_from);
                             },
                             [](const Disk& s) { return kPiExact * s.radius * s.radius; }},
                    shape);
}

Vec middle(const Shape& shape) {
  return std::visit(
      Overload{[](const Quad& s) { return s.corner + 0.5 * (s.u + s.v); },
               [](const Triangle& s) { return (s.a + s.b + s.c) / 3.0; }, [](const Sphere& s) { return s.center; },
               [](const Frustum& s) { return 0.5 * (s.from + s.to); }, [](const Disk& s) { return s.center; }},
      shape);
}

Vec flat_normal(const Shape& shape) {
  return std::visit(Overload{[](const Quad& s) { return glm::normalize(glm::cross(s.u, s.v)); },
                             [](const Triangle& s) { return glm::normalize(glm::cross(s.b - s.a, s.c - s.a)); },
                             [](const Disk& s) { return s.normal; }, [](const auto&) { return Vec(0); }},
                    shape);
}

}  // namespace path_tracer
