// Embree behind Geometry.
#include "path_tracer/geometry.h"

#include <embree3/rtcore.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace path_tracer {

namespace {

struct GroupSurface {
  Shape shape;
  int material, object, emitter;
  double texture_scale;  // lengths of the group in a unit of the object
};

enum Part : unsigned { kQuads, kTriangles, kCurved, kParts };

// What user-geometry callbacks see.
struct Curved {
  const std::vector<GroupSurface>* surfaces;
  std::vector<std::uint32_t> index;  // of primitives among the surfaces
};

const GroupSurface& curved_surface(const void* user, unsigned primitive) {
  const auto& part = *static_cast<const Curved*>(user);
  return (*part.surfaces)[part.index[primitive]];
}

void curved_bounds(const RTCBoundsFunctionArguments* a) {
  const Bounds b = bounds(curved_surface(a->geometryUserPtr, a->primID).shape);
  // Rounded outwards, since rounding to single precision may cut a little off.
  const Vec slack = 1e-6 * (1.0 + glm::abs(b.low) + glm::abs(b.high));
  const glm::vec3 low(b.low - slack), high(b.high + slack);
  *a->bounds_o = {low.x, low.y, low.z, 0, high.x, high.y, high.z, 0};
}

double curved_crossing(const void* user, unsigned primitive, const RTCRay& r) {
  const Ray ray{{r.org_x, r.org_y, r.org_z}, {r.dir_x, r.dir_y, r.dir_z}};
  return crossing(curved_surface(user, primitive).shape, ray, r.tnear, r.tfar);
}

void curved_intersect(const RTCIntersectFunctionNArguments* a) {
  if (!a->valid[0]) return;
  auto& hit = *reinterpret_cast<RTCRayHit*>(a->rayhit);
  const double t = curved_crossing(a->geometryUserPtr, a->primID, hit.ray);
  if (t < 0) return;
  hit.ray.tfar = float(t);
  hit.hit.geomID = a->geomID;
  hit.hit.primID = a->primID;
}

void curved_occluded(const RTCOccludedFunctionNArguments* a) {
  if (!a->valid[0]) return;
  auto& ray = *reinterpret_cast<RTCRay*>(a->ray);
  if (curved_crossing(a->geometryUserPtr, a->primID, ray) >= 0) ray.tfar = -std::numeric_limits<float>::infinity();
}

// Vertices of flat surfaces, `corners` each, as one Embree geometry.
void attach_flat(RTCDevice device, RTCScene scene, unsigned id, const std::vector<Vec>& vertices, unsigned corners) {
  const bool quads = corners == 4;
  RTCGeometry g = rtcNewGeometry(device, quads ? RTC_GEOMETRY_TYPE_QUAD : RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* v = static_cast<float*>(
      rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices.size()));
  auto* index = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, quads ? RTC_FORMAT_UINT4 : RTC_FORMAT_UINT3,
                              corners * sizeof(std::uint32_t), vertices.size() / corners));
  if (!v || !index) throw std::runtime_error("Embree has no memory for the scene");
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (int c = 0; c < 3; ++c) v[3 * i + std::size_t(c)] = float(vertices[i][c]);
    index[i] = std::uint32_t(i);
  }
  rtcCommitGeometry(g);
  rtcAttachGeometryByID(scene, g, id);
  rtcReleaseGeometry(g);
}

RTCRay embree_ray(const Ray& ray, double far) {
  RTCRay r{};
  r.org_x = float(ray.origin.x), r.org_y = float(ray.origin.y), r.org_z = float(ray.origin.z);
  r.dir_x = float(ray.direction.x), r.dir_y = float(ray.direction.y), r.dir_z = float(ray.direction.z);
  r.tnear = 0;
  r.tfar = far < 1e30 ? float(far) : std::numeric_limits<float>::infinity();
  r.mask = ~0u;
  return r;
}

}  // namespace

struct Geometry::Device {
  // Embree's "threads=1" would hold TBB to one thread in the whole process, for good. With more user threads than there
  // are cores, a joined build runs in the calling thread alone and nobody else is affected.
  Device() : device(rtcNewDevice("user_threads=1024")) {
    if (!device) throw std::runtime_error("Embree did not start, error " + std::to_string(rtcGetDeviceError(nullptr)));
  }
  ~Device() { rtcReleaseDevice(device); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  RTCDevice device;
};

struct Geometry::Group {
  ~Group() {
    if (scene) rtcReleaseScene(scene);
  }

  void build(RTCDevice device) {
    scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    curved.surfaces = &surfaces;
    std::vector<Vec> quads, triangles;
    Vec low(kFarAway), high(-kFarAway);
    for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
      const Shape& shape = surfaces[i].shape;
      const Bounds b = bounds(shape);
      low = glm::min(low, b.low), high = glm::max(high, b.high);
      if (const auto* q = std::get_if<Quad>(&shape)) {
        part[kQuads].push_back(i);
        quads.insert(quads.end(), {q->corner, q->corner + q->u, q->corner + q->u + q->v, q->corner + q->v});
      } else if (const auto* t = std::get_if<Triangle>(&shape)) {
        part[kTriangles].push_back(i);
        triangles.insert(triangles.end(), {t->a, t->b, t->c});
      } else {
        part[kCurved].push_back(i);
      }
    }
    if (!surfaces.empty()) center = 0.5 * (low + high), radius = 0.5 * glm::length(high - low) * (1 + 1e-6);
    if (!quads.empty()) attach_flat(device, scene, kQuads, quads, 4);
    if (!triangles.empty()) attach_flat(device, scene, kTriangles, triangles, 3);
    curved.index = part[kCurved];
    if (!curved.index.empty()) {
      RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
      rtcSetGeometryUserPrimitiveCount(g, unsigned(curved.index.size()));
      rtcSetGeometryUserData(g, &curved);
      rtcSetGeometryBoundsFunction(g, curved_bounds, nullptr);
      rtcSetGeometryIntersectFunction(g, curved_intersect);
      rtcSetGeometryOccludedFunction(g, curved_occluded);
      rtcCommitGeometry(g);
      rtcAttachGeometryByID(scene, g, kCurved);
      rtcReleaseGeometry(g);
    }
    rtcJoinCommitScene(scene);
    if (const RTCError error = rtcGetDeviceError(device))
      throw std::runtime_error("Embree failed to build the scene, error " + std::to_string(error));
  }

  // Whether the ray, in world space, can meet a group that stands at `to_world`.
  bool near(const Mat& to_world, const Ray& ray) const {
    const Vec o = point(to_world, center) - ray.origin;
    const double reach = radius * glm::length(Vec(to_world[0])), d = glm::dot(ray.direction, ray.direction);
    const Vec across = o - ray.direction * (glm::dot(o, ray.direction) / d);
    return glm::dot(across, across) <= reach * reach;
  }

  static constexpr double kFarAway = 1e30;
  RTCScene scene = nullptr;
  int object = -1;  // of a moving group
  std::vector<GroupSurface> surfaces;
  std::vector<std::uint32_t> part[kParts];
  Curved curved;
  Vec center{0};
  double radius = 0;
};

Geometry::Geometry(const Scene& scene) : scene_(&scene), device_(std::make_unique<Device>()) {
  groups_.push_back(std::make_unique<Group>());
  for (int o = 0; o < int(scene.objects.size()); ++o) {
    const Object& object = scene.objects[std::size_t(o)];
    const bool moves = object.pose.moves();
    if (moves) groups_.push_back(std::make_unique<Group>()), groups_.back()->object = o;
    const int g = moves ? int(groups_.size()) - 1 : 0;
    Group& group = *groups_[std::size_t(g)];
    const Pose pose = object.pose.pose(0);
    const double scale = moves ? 1 : pose.scale;
    for (const Surface& s : object.surfaces) {
      const Shape shape = moves ? s.shape : transformed(s.shape, pose.matrix(), scale);
      int emitter = -1;
      if (scene.materials[std::size_t(s.material)].kind == Material::Kind::emitter) {
        emitter = int(emitters_.size());
        emitters_.push_back({g, std::uint32_t(group.surfaces.size()), s.material, shape});
      }
      group.surfaces.push_back({shape, s.material, o, emitter, scale});
    }
  }
  for (auto& group : groups_) group->build(device_->device);
}

Geometry::~Geometry() = default;
Geometry::Geometry(Geometry&&) noexcept = default;

Placement Geometry::place(double time) const {
  Placement p;
  for (const Object& o : scene_->objects) p.to_world.push_back(o.pose.pose(time).matrix());
  for (const auto& g : groups_) {
    p.from_group.push_back(g->object < 0 ? Mat(1) : p.to_world[std::size_t(g->object)]);
    p.to_group.push_back(glm::inverse(p.from_group.back()));
  }
  return p;
}

int Geometry::emitter_of(int group, std::uint32_t surface) const {
  return groups_[std::size_t(group)]->surfaces[surface].emitter;
}

std::optional<Hit> Geometry::intersect(const Placement& p, const Ray& ray) const {
  Hit hit;
  double far = std::numeric_limits<double>::infinity();
  const Group* found = nullptr;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Group& group = *groups_[g];
    if (g && !group.near(p.from_group[g], ray)) continue;
    const Ray local = g ? Ray{point(p.to_group[g], ray.origin), direction(p.to_group[g], ray.direction)} : ray;
    RTCRayHit r{embree_ray(local, far), {}};
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(group.scene, &context, &r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    hit.group = int(g);
    hit.surface = group.part[r.hit.geomID][r.hit.primID];
    found = &group;
    far = r.ray.tfar;
  }
  if (!found) return std::nullopt;
  const GroupSurface& s = found->surfaces[hit.surface];
  const auto g = std::size_t(hit.group);
  hit.object = s.object, hit.material = s.material;
  if (!g) {
    hit.point = locate(s.shape, ray, far);
  } else {
    const Ray local{point(p.to_group[g], ray.origin), direction(p.to_group[g], ray.direction)};
    hit.point = locate(s.shape, local, far);
    hit.point.position = point(p.from_group[g], hit.point.position);
    hit.point.normal = glm::normalize(direction(p.from_group[g], hit.point.normal));
  }
  hit.point.texture /= s.texture_scale;
  return hit;
}

bool Geometry::occluded(const Placement& p, const Ray& ray, double far) const {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Group& group = *groups_[g];
    if (g && !group.near(p.from_group[g], ray)) continue;
    RTCRay r =
        embree_ray(g ? Ray{point(p.to_group[g], ray.origin), direction(p.to_group[g], ray.direction)} : ray, far);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(group.scene, &context, &r);
    if (r.tfar < 0) return true;
  }
  return false;
}

}  // namespace path_tracer
