// Lamps and openings at one time, and how to aim at them.
#pragma once

#include "path_tracer/geometry.h"

#include <vector>

namespace path_tracer {

// A point of a surface that is to be lit, on the side of `normal`, and the light that was chosen for it.
struct Receiver {
  Vec position, normal;
  int light = -1;     // -1: none can reach it
  double weight = 0;  // of that light, and of all
  double total = 0;
};

struct LightSample {
  Vec direction{0};
  double distance = 0;  // infinite for the environment
  Rgb radiance{0};
  float pdf = 0;  // per solid angle, the choice of the light included; 0: nothing to gain
};

// All lights of a scene at one time. A light is chosen with a probability in proportion to what it could send to a
// point if nothing were in between, which needs no memory and is unbiased.
class Lights {
 public:
  Lights(const Scene&, const Geometry&, const Placement&, double time);

  Receiver receiver(const Vec& position, const Vec& normal, float choice) const;
  LightSample sample(const Receiver&, const glm::vec2& u) const;
  // Density with which `sample` picks this direction from the receiver: where a ray in it ends on an emitter, and where
  // it ends nowhere.
  float pdf(const Receiver&, const Vec& direction, const Hit&) const;
  float pdf_environment(const Receiver&, const Vec& direction) const;
  // What an emitter shows to a viewer along the ray.
  Rgb radiance(const Hit&, const Ray&) const;

 private:
  struct Light {
    Shape shape;
    Rgb radiance;
    bool two_sided, portal;
    Vec center, normal;
    double area, power, radius2;
    Vec hull, edges[3];  // a parallelepiped around it: corner and edges
  };
  static Light make(const Shape&, const Rgb& radiance, bool two_sided, bool portal);
  static double weight(const Light&, const Vec& at, const Vec& normal);
  // Density over solid angle of picking the ray's direction on this light, where the ray meets it at t.
  static double solid_pdf(const Light&, const Ray&, double t);

  const Scene* scene_;
  const Geometry* geometry_;
  std::vector<Light> lights_;  // emitters in the order of Geometry::emitters, then portals
};

}  // namespace path_tracer
