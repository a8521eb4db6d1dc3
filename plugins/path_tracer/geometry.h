// Finds where rays meet a scene, by Embree: one hierarchy for all that stands still, in world space, and one for each
// moving object, in its own space, entered by transforming the ray. So the hierarchies are built once and nothing that
// is kept depends on the frame.
#pragma once

#include "path_tracer/scene.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace path_tracer {

// Where things stand at one time. Group 0 is what stands still; each moving object is a group of its own.
struct Placement {
  std::vector<Mat> to_world;    // one an object
  std::vector<Mat> from_group;  // group to world, one a group; the identity for group 0
  std::vector<Mat> to_group;
};

struct Hit {
  int group = 0;
  std::uint32_t surface = 0;  // of the group
  int object = 0;
  int material = 0;
  SurfacePoint point;  // position and normal in world space
};

class Geometry {
 public:
  explicit Geometry(const Scene&);
  ~Geometry();
  Geometry(Geometry&&) noexcept;

  Placement place(double time) const;
  // First surface along the ray, if any.
  std::optional<Hit> intersect(const Placement&, const Ray&) const;
  // Whether anything lies between the ends of origin + [0, far) direction.
  bool occluded(const Placement&, const Ray&, double far) const;

  // An emitting surface, in the space of its group.
  struct Emitter {
    int group;
    std::uint32_t surface;
    int material;
    Shape shape;
  };
  const std::vector<Emitter>& emitters() const { return emitters_; }
  // Index into `emitters`, or -1.
  int emitter_of(int group, std::uint32_t surface) const;

 private:
  struct Device;
  struct Group;

  const Scene* scene_;
  std::unique_ptr<Device> device_;
  std::vector<std::unique_ptr<Group>> groups_;
  std::vector<Emitter> emitters_;
};

}  // namespace path_tracer
