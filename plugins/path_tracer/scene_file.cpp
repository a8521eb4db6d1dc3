// Reads scene files: materials, objects, emitters, environment, camera and their keyframes.
#include "path_tracer/json_fields.h"
#include "path_tracer/scene.h"

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace path_tracer {

namespace {

constexpr Range kAny{}, kPositive{1e-6, 1e6}, kNotNegative{0, 1e9}, kUnit{0, 1};
constexpr int kMaxRepeat = 10000;

std::string indexed(const std::string& where, std::size_t i) { return where + "[" + std::to_string(i) + "]"; }

Rgb reflectance(const Fields& f, const char* key) { return Rgb(f.vector(key, kUnit)); }

// ---- Keyframes ----

template <int N>
void check_times(const Track<N>& track, const Fields& f, const std::string& place) {
  for (std::size_t i = 1; i < track.at.size(); ++i)
    if (!(track.at[i] > track.at[i - 1]))
      f.problems().add(indexed(place, i) + ".at", "keys must be in order of time, and no two at one time");
  if (track.loop > 0 && track.at.size() > 1 && (track.at.front() != 0 || track.at.back() != track.loop))
    f.problems().add(place, "in a looping scene the keys must begin at 0 and end at " +
                                std::to_string(int(track.loop)) + ", the scene's 'loop'");
}

// `base` gives the values where there are no keys; `read` takes one key's object to its values.
template <int N, class Read>
void read_track(Track<N>& track, const Fields& f, double loop, std::initializer_list<const char*> known, Read&& read) {
  track.loop = loop;
  if (const int ease = f.choice("ease", {"step", "linear", "smooth"}, int(Ease::smooth)); ease >= 0)
    track.ease = Ease(ease);
  if (!f.has("keys")) {
    track.at = {0};
    track.value = {read(f)};
    return;
  }
  const Json& keys = f.array("keys");
  if (keys.empty()) f.problem("keys", "needs at least one key");
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Fields key(keys[i], indexed(f.place("keys"), i), f.problems(), known);
    track.at.push_back(key.number("at", kAny));
    track.value.push_back(read(key));
  }
  check_times(track, f, f.place("keys"));
  if (track.at.empty()) track.at = {0}, track.value = {read(f)};
}

// ---- Materials ----

Texture read_texture(const Json& json, const std::string& where, Problems& problems) {
  Texture t;
  if (json.is_array()) {
    t.a = Rgb(Fields::as_vector(json, where, kUnit, problems));
    return t;
  }
  const Fields f(json, where, problems, {"pattern", "a", "b", "size", "angle", "octaves"});
  const int pattern = f.choice("pattern", {"checker", "stripes", "noise"});
  t.pattern = Texture::Pattern(pattern + 1);
  t.a = reflectance(f, "a");
  t.b = reflectance(f, "b");
  t.size = f.number("size", kPositive);
  t.angle = glm::radians(f.number("angle", kAny, 0));
  t.octaves = f.integer("octaves", 1, 12, 4);
  return t;
}

Material read_material(const Json& json, const std::string& where, double loop, Problems& problems) {
  const Fields f(json, where, problems, {"type", "color", "roughness", "ior", "radiance", "strength", "two_sided"});
  Material m;
  const int kind = f.choice("type", {"diffuse", "plastic", "conductor", "mirror", "glass", "emitter"});
  if (kind < 0) return m;
  m.kind = Material::Kind(kind);
  if (m.kind == Material::Kind::emitter) {
    m.radiance = Rgb(f.vector("radiance", kNotNegative));
    m.two_sided = f.flag("two_sided", false);
    const Json constant{{"value", 1.0}};
    const Json* strength = f.find("strength");
    const Json wrapped = strength && strength->is_number() ? Json{{"value", *strength}} : Json();
    const Json& track = !strength ? constant : strength->is_number() ? wrapped : *strength;
    read_track(m.strength, Fields(track, f.place("strength"), problems, {"value", "keys", "ease"}), loop,
               {"at", "value"}, [](const Fields& key) { return Track<1>::Value{key.number("value", kNotNegative)}; });
    return m;
  }
  if (const Json* color = f.find("color"))
    m.color = read_texture(*color, f.place("color"), problems);
  else if (m.kind == Material::Kind::glass || m.kind == Material::Kind::mirror)
    m.color.a = Rgb(1);
  else
    f.problem("color", "missing");
  m.roughness = float(f.number("roughness", {0.03, 1}, m.roughness));
  m.ior = float(f.number("ior", {1, 4}, m.ior));
  return m;
}

// ---- Shapes ----

void add_box(const Vec& low, const Vec& high, int material, std::vector<Surface>& out) {
  const Vec size = high - low, x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  for (const Quad& q :
       {Quad{low, z, y}, Quad{low, x, z}, Quad{low, y, x}, Quad{high, -y, -z}, Quad{high, -z, -x}, Quad{high, -x, -y}})
    out.push_back({q, material});
}

void add_mesh(const Fields& f, int material, std::vector<Surface>& out) {
  const Json &vertices = f.array("vertices"), &triangles = f.array("triangles");
  std::vector<Vec> v;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    v.push_back(Fields::as_vector(vertices[i], indexed(f.place("vertices"), i), kAny, f.problems()));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::string place = indexed(f.place("triangles"), i);
    const double last = double(v.size()) - 1;
    const Vec at = Fields::as_vector(triangles[i], place, {0, std::max(0.0, last)}, f.problems());
    if (last < 0) continue;
    const Vec a = v[std::size_t(at.x)], b = v[std::size_t(at.y)], c = v[std::size_t(at.z)];
    const Vec n = glm::cross(b - a, c - a), size = glm::abs(n);
    if (!(glm::length(n) > 0)) {
      f.problems().add(place, "the triangle has no area");
      continue;
    }
    // Texture by projection along the axis that the triangle faces most, so that neighbours join.
    const int drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    const auto flat = [&](const Vec& p) { return glm::dvec2(p[(drop + 1) % 3], p[(drop + 2) % 3]); };
    out.push_back({Triangle{a, b, c, flat(a), flat(b), flat(c)}, material});
  }
}

void add_frustum(const Fields& f, int material, std::vector<Surface>& out) {
  Frustum s{f.vector("from"), f.vector("to"), 0, 0};
  const Json* radius = f.find("radius");
  if (radius && radius->is_array() && radius->size() == 2) {
    s.radius_from = Fields::as_number((*radius)[0], f.place("radius[0]"), kNotNegative, f.problems());
    s.radius_to = Fields::as_number((*radius)[1], f.place("radius[1]"), kNotNegative, f.problems());
  } else {
    s.radius_from = s.radius_to = f.number("radius", kPositive);
  }
  if (!(glm::length(s.to - s.from) > 0)) {
    f.problem("to", "must differ from 'from'");
    return;
  }
  out.push_back({s, material});
  if (!f.flag("caps", true)) return;
  const Vec axis = glm::normalize(s.to - s.from);
  if (s.radius_from > 0) out.push_back({Disk{s.from, -axis, s.radius_from}, material});
  if (s.radius_to > 0) out.push_back({Disk{s.to, axis, s.radius_to}, material});
}

Quad read_quad(const Fields& f) {
  const Quad q{f.vector("corner"), f.vector("u"), f.vector("v")};
  if (!(glm::length(glm::cross(q.u, q.v)) > 0)) f.problem("v", "'u' and 'v' must span an area");
  return q;
}

void read_shape(const Json& json, const std::string& where, const std::map<std::string, int>& materials,
                const Scene& scene, Problems& problems, std::vector<Surface>& out) {
  const Fields f(json, where, problems,
                 {"type", "material", "corner", "u", "v", "min", "max", "center", "radius", "from", "to", "caps",
                  "normal", "vertices", "triangles", "repeat"});
  const int type = f.choice("type", {"quad", "box", "sphere", "frustum", "disk", "mesh"});
  const std::string name = f.text("material");
  const auto material = materials.find(name);
  if (material == materials.end()) {
    std::string all;
    for (const auto& [known, index] : materials) all += (all.empty() ? "" : ", ") + known;
    f.problem("material", "no material is called '" + name + "'; there are: " + all);
  }
  if (type < 0 || material == materials.end()) return;
  std::vector<Surface> made;
  switch (type) {
    case 0:
      made.push_back({read_quad(f), material->second});
      break;
    case 1: {
      const Vec low = f.vector("min"), high = f.vector("max");
      if (glm::any(glm::lessThanEqual(high, low))) f.problem("max", "must be greater than 'min' in every coordinate");
      add_box(low, high, material->second, made);
      break;
    }
    case 2:
      made.push_back({Sphere{f.vector("center"), f.number("radius", kPositive)}, material->second});
      break;
    case 3:
      add_frustum(f, material->second, made);
      break;
    case 4: {
      const Vec n = f.vector("normal");
      if (!(glm::length(n) > 0)) f.problem("normal", "must not be zero");
      made.push_back({Disk{f.vector("center"), glm::normalize(n), f.number("radius", kPositive)}, material->second});
      break;
    }
    default:
      add_mesh(f, material->second, made);
      break;
  }
  if (scene.materials[std::size_t(material->second)].kind == Material::Kind::emitter)
    for (const Surface& s : made)
      if (std::holds_alternative<Frustum>(s.shape)) {
        f.problem("material", "a frustum cannot emit; emitters are quads, boxes, spheres, disks and meshes");
        break;
      }
  int count = 1;
  Vec step(0);
  if (f.has("repeat")) {
    const Fields repeat(f.object("repeat"), f.place("repeat"), problems, {"count", "step"});
    count = repeat.integer("count", 1, kMaxRepeat, 1);
    step = repeat.vector("step");
  }
  for (int i = 0; i < count; ++i) {
    Mat shift(1);
    shift[3] = glm::dvec4(step * double(i), 1);
    for (const Surface& s : made) out.push_back({transformed(s.shape, shift, 1), s.material});
  }
}

// ---- The whole ----

Object read_object(const Json& json, const std::string& where, const std::map<std::string, int>& materials,
                   const Scene& scene, double loop, Problems& problems) {
  const Fields f(json, where, problems, {"name", "shapes", "translate", "rotate", "scale", "keys", "ease"});
  Object object;
  object.name = f.text("name");
  read_track(object.pose, f, loop, {"at", "translate", "rotate", "scale"}, [&](const Fields& key) {
    const Vec t = key.vector("translate", kAny, f.vector("translate", kAny, Vec(0)));
    const Vec r = key.vector("rotate", kAny, f.vector("rotate", kAny, Vec(0)));
    return Track<7>::Value{
        t.x, t.y, t.z, r.x, r.y, r.z, key.number("scale", kPositive, f.number("scale", kPositive, 1))};
  });
  const Json& shapes = f.array("shapes");
  for (std::size_t i = 0; i < shapes.size(); ++i)
    read_shape(shapes[i], indexed(f.place("shapes"), i), materials, scene, problems, object.surfaces);
  if (object.surfaces.empty() && shapes.empty()) f.problem("shapes", "needs at least one shape");
  return object;
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name) {
  const Json json = parse_json(text, name);
  Problems problems(name);
  const Fields f(json, "", problems,
                 {"quell_scene", "about", "loop", "environment", "camera", "materials", "objects", "portals"});
  if (f.integer("quell_scene", 0, 1 << 30, 0) != 1) f.problem("quell_scene", "must be 1, the version of this format");
  Scene scene;
  const double loop = f.integer("loop", 1, 1000000, 0);
  if (f.has("environment")) {
    const Fields e(f.object("environment"), "environment", problems, {"horizon", "zenith"});
    scene.environment.horizon = Rgb(e.vector("horizon", kNotNegative));
    scene.environment.zenith = Rgb(e.vector("zenith", kNotNegative, Vec(scene.environment.horizon)));
  }
  const Fields camera(f.object("camera"), "camera", problems, {"position", "target", "fov", "keys", "ease"});
  read_track(scene.camera, camera, loop, {"at", "position", "target", "fov"}, [&](const Fields& key) {
    const Vec p = key.has("position") ? key.vector("position") : camera.vector("position");
    const Vec t = key.has("target") ? key.vector("target") : camera.vector("target");
    if (const Vec d = t - p; !(std::hypot(d.x, d.z) > 1e-9))
      key.problem("target", "the camera may not stand in its target or look straight up or down");
    return Track<7>::Value{
        p.x, p.y, p.z, t.x, t.y, t.z, key.number("fov", {1, 170}, camera.number("fov", {1, 170}, 60))};
  });
  std::map<std::string, int> materials;
  for (const auto& [key, value] : f.object("materials").items()) {
    materials.emplace(key, int(scene.materials.size()));
    scene.materials.push_back(read_material(value, "materials." + key, loop, problems));
  }
  const Json& objects = f.array("objects");
  if (objects.empty()) f.problem("objects", "needs at least one object");
  for (std::size_t i = 0; i < objects.size(); ++i)
    scene.objects.push_back(read_object(objects[i], indexed("objects", i), materials, scene, loop, problems));
  if (f.has("portals")) {
    const Json& portals = f.array("portals");
    for (std::size_t i = 0; i < portals.size(); ++i)
      scene.portals.push_back(read_quad(Fields(portals[i], indexed("portals", i), problems, {"corner", "u", "v"})));
  }
  problems.raise();
  return scene;
}

Scene read_scene(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(file + ": cannot open the scene file; set 'scene' to one that exists");
  std::ostringstream text;
  text << in.rdbuf();
  return parse_scene(text.str(), file);
}

}  // namespace path_tracer
