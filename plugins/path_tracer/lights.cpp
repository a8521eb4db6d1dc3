// Next-event estimation: choosing lamps, points on them, and the densities that multiple importance sampling needs.
#include "path_tracer/lights.h"

#include <limits>

namespace path_tracer {

namespace {

// 1 - cosine of the cone in which a sphere is seen, without cancellation; 1 or more from inside.
double cone(const Sphere& s, const Vec& at) {
  const double sine2 = s.radius * s.radius / std::max(glm::dot(s.center - at, s.center - at), 1e-300);
  return sine2 >= 1 ? 2 : sine2 / (1 + std::sqrt(1 - sine2));
}

// A point chosen uniformly by area on a flat shape.
Vec uniform_point(const Shape& shape, const glm::vec2& u) {
  if (const auto* q = std::get_if<Quad>(&shape)) return q->corner + q->u * double(u.x) + q->v * double(u.y);
  if (const auto* t = std::get_if<Triangle>(&shape)) {
    const double root = std::sqrt(u.x);
    return t->a * (1 - root) + t->b * (root * (1 - u.y)) + t->c * (root * u.y);
  }
  const auto& d = std::get<Disk>(shape);
  const Frame frame(d.normal);
  const double r = d.radius * std::sqrt(u.x), phi = 2 * kPiExact * u.y;
  return d.center + frame.s * (r * std::cos(phi)) + frame.t * (r * std::sin(phi));
}

double crossing_flat(const Quad& q, const Ray& ray) {
  const Vec n = glm::cross(q.u, q.v);
  const double slope = glm::dot(ray.direction, n);
  if (slope == 0) return -1;
  const double t = glm::dot(q.corner - ray.origin, n) / slope;
  const Vec across = ray.origin + ray.direction * t - q.corner;
  const double scale = 1 / glm::dot(n, n);
  const double a = glm::dot(glm::cross(across, q.v), n) * scale, b = glm::dot(glm::cross(q.u, across), n) * scale;
  return a >= 0 && a <= 1 && b >= 0 && b <= 1 ? t : -1;
}

}  // namespace

Lights::Light Lights::make(const Shape& shape, const Rgb& radiance, bool two_sided, bool portal) {
  const Bounds b = bounds(shape);
  const Vec half = 0.5 * (b.high - b.low);
  const double size = area(shape);
  Light light{shape,
              radiance,
              two_sided,
              portal,
              middle(shape),
              flat_normal(shape),
              size,
              size * luminance(radiance),
              std::max(0.25 * glm::dot(half, half), 1e-12),
              b.low,
              {Vec(2 * half.x, 0, 0), Vec(0, 2 * half.y, 0), Vec(0, 0, 2 * half.z)}};
  if (const auto* q = std::get_if<Quad>(&shape))
    light.hull = q->corner, light.edges[0] = q->u, light.edges[1] = q->v, light.edges[2] = Vec(0);
  return light;
}

Lights::Lights(const Scene& scene, const Geometry& geometry, const Placement& placement, double time)
    : scene_(&scene), geometry_(&geometry) {
  for (const auto& e : geometry.emitters()) {
    const Material& m = scene.materials[std::size_t(e.material)];
    const Mat& to_world = placement.from_group[std::size_t(e.group)];
    const Shape shape = transformed(e.shape, to_world, glm::length(Vec(to_world[0])));
    lights_.push_back(make(shape, m.radiance * float(m.strength.sample(time)[0]), m.two_sided, false));
  }
  const Rgb sky = 0.5f * (scene.environment.horizon + scene.environment.zenith);
  for (const Quad& portal : scene.portals) lights_.push_back(make(portal, sky, true, true));
}

double Lights::weight(const Light& light, const Vec& at, const Vec& normal) {
  // Nothing of the light is seen if all of it lies below the receiver's horizon.
  double above = glm::dot(light.hull - at, normal);
  for (const Vec& edge : light.edges) above += std::max(0.0, glm::dot(edge, normal));
  if (above <= 0) return 0;
  const Vec away = at - light.center;
  const double reach2 = std::max(glm::dot(away, away), light.radius2), reach = std::sqrt(reach2);
  double leaving = reach;  // times the cosine at a flat light
  if (!std::holds_alternative<Sphere>(light.shape)) {
    const double side = glm::dot(away, light.normal);
    leaving = std::min(reach, light.two_sided ? std::abs(side) : std::max(0.0, side));
  }
  return light.power * leaving * std::min(reach, above) / (reach2 * reach2);
}

Receiver Lights::receiver(const Vec& position, const Vec& normal, float choice) const {
  Receiver r{position, normal};
  double u = choice;
  // Weighted choice in one pass; what is left of `u` after each step is uniform again.
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const double w = weight(lights_[i], position, normal);
    if (!(w > 0)) continue;
    r.total += w;
    const double split = w / r.total;
    if (u < split) {
      r.light = int(i), r.weight = w;
      u /= split;
    } else {
      u = (u - split) / (1 - split);
    }
  }
  return r;
}

double Lights::solid_pdf(const Light& light, const Ray& ray, double t) {
  if (const auto* s = std::get_if<Sphere>(&light.shape)) return 1 / (2 * kPiExact * cone(*s, ray.origin));
  const double length = glm::length(ray.direction);
  const double cosine = std::abs(glm::dot(ray.direction, light.normal)) / length;
  return cosine > 0 ? t * t * length * length / (cosine * light.area) : 0;
}

LightSample Lights::sample(const Receiver& receiver, const glm::vec2& u) const {
  if (receiver.light < 0) return {};
  const Vec& at = receiver.position;
  const Light* light = &lights_[std::size_t(receiver.light)];
  LightSample s;
  const double share = receiver.weight / receiver.total;
  if (const auto* sphere = std::get_if<Sphere>(&light->shape)) {
    const double width = cone(*sphere, at), cosine = 1 - u.x * width, phi = 2 * kPiExact * u.y;
    const double sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
    const Vec to = sphere->center - at;
    const double distance = glm::length(to);
    const Frame frame(distance > 0 ? to / distance : Vec(0, 1, 0));
    s.direction = frame.s * (sine * std::cos(phi)) + frame.t * (sine * std::sin(phi)) + frame.n * cosine;
    const bool inside = width == 2;
    if (inside && !light->two_sided) return {};
    // Distance to the sphere along the direction; at the rim rounding may miss it, where it is that of the tangent.
    const double along = distance * cosine, rest = sphere->radius * sphere->radius - distance * distance * sine * sine;
    s.distance = along + (inside ? 1 : -1) * std::sqrt(std::max(0.0, rest));
    s.pdf = float(share / (2 * kPiExact * width));
    s.radiance = light->radiance;
    return s;
  }
  const Vec to = uniform_point(light->shape, u) - at;
  const double distance2 = glm::dot(to, to);
  if (!(distance2 > 0)) return {};
  s.distance = std::sqrt(distance2);
  s.direction = to / s.distance;
  const double facing = -glm::dot(s.direction, light->normal);
  if (facing == 0 || (facing < 0 && !light->two_sided)) return {};
  if (light->portal) {
    s.radiance = scene_->environment.at(s.direction);
    s.distance = std::numeric_limits<double>::infinity();
    s.pdf = pdf_environment(receiver, s.direction);
    return s;
  }
  s.radiance = light->radiance;
  s.pdf = float(share * distance2 / (std::abs(facing) * light->area));
  return s;
}

float Lights::pdf(const Receiver& receiver, const Vec& direction, const Hit& hit) const {
  const int e = geometry_->emitter_of(hit.group, hit.surface);
  if (e < 0 || !(receiver.total > 0)) return 0;
  const Light& light = lights_[std::size_t(e)];
  return float(weight(light, receiver.position, receiver.normal) / receiver.total *
               solid_pdf(light, {receiver.position, direction}, hit.point.t));
}

float Lights::pdf_environment(const Receiver& receiver, const Vec& direction) const {
  if (!(receiver.total > 0)) return 0;
  const Ray ray{receiver.position, direction};
  // Openings may lie one behind the other; each could have given the direction.
  double sum = 0;
  for (std::size_t i = geometry_->emitters().size(); i < lights_.size(); ++i) {
    const double t = crossing_flat(std::get<Quad>(lights_[i].shape), ray);
    if (t > 0)
      sum += weight(lights_[i], receiver.position, receiver.normal) / receiver.total * solid_pdf(lights_[i], ray, t);
  }
  return float(sum);
}

Rgb Lights::radiance(const Hit& hit, const Ray& ray) const {
  const int e = geometry_->emitter_of(hit.group, hit.surface);
  if (e < 0) return Rgb(0);
  const Light& light = lights_[std::size_t(e)];
  return light.two_sided || glm::dot(ray.direction, hit.point.normal) < 0 ? light.radiance : Rgb(0);
}

}  // namespace path_tracer
