// A scene as data: what a scene file says, checked, in the order in which it says it.
#pragma once

#include "path_tracer/animation.h"
#include "path_tracer/shapes.h"

#include <string>
#include <string_view>
#include <vector>

namespace path_tracer {

// A colour that varies over a surface; `size` is in the units of the object.
struct Texture {
  enum class Pattern { constant, checker, stripes, noise };
  Pattern pattern = Pattern::constant;
  Rgb a{0.5f}, b{0};
  double size = 1;   // of a square of the checker, of a pair of stripes, of the coarsest bumps of the noise
  double angle = 0;  // stripes: radians from the first direction of the surface
  int octaves = 4;   // noise

  Rgb at(const glm::dvec2& surface) const;
};

struct Material {
  enum class Kind { diffuse, plastic, conductor, mirror, glass, emitter };
  Kind kind = Kind::diffuse;
  Texture color;           // reflectance: of a conductor or mirror at normal incidence
  float roughness = 0.2f;  // plastic and conductor; GGX alpha is its square
  float ior = 1.5f;        // plastic and glass
  Rgb radiance{0};         // emitter
  Track<1> strength;       // emitter: factor of the radiance over time
  bool two_sided = false;  // emitter
};

struct Surface {
  Shape shape;
  int material;
};

// A rigid body, or all that never moves under one name. Its number is the id of its pixels.
struct Object {
  std::string name;
  PoseTrack pose;
  std::vector<Surface> surfaces;  // in the object's own space
};

struct Environment {
  Rgb horizon{0}, zenith{0};
  Rgb at(const Vec& direction) const { return horizon + (zenith - horizon) * float(std::max(0.0, direction.y)); }
};

struct CameraTrack : Track<7> {  // position, target, horizontal field of view in degrees
};

struct Scene {
  std::vector<Material> materials;
  std::vector<Object> objects;
  std::vector<Quad> portals;  // openings through which the environment is sampled
  Environment environment;
  CameraTrack camera;
};

// Reads a scene file. Throws std::runtime_error that lists every problem with its place.
Scene read_scene(const std::string& file);
// The same from text; `name` stands for the file in messages.
Scene parse_scene(std::string_view text, const std::string& name);

}  // namespace path_tracer
