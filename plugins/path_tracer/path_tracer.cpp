// A source of sequences with nothing unknown about them: path-traces an animated scene file and gives exact feature
// buffers, so that filters can be tried and measured without any renderer.
#include "path_tracer/camera.h"
#include "path_tracer/integrator.h"

#include <quell/node.h>

#include <string>

namespace {

using namespace path_tracer;

enum class Jitter : std::int32_t { center, box };
enum class Features : std::int32_t { first, followed };

// Stays in one place: the geometry points into the scene.
struct Stage {
  explicit Stage(const std::string& file) : scene(std::make_unique<Scene>(read_scene(file))), geometry(*scene) {}
  std::unique_ptr<Scene> scene;
  Geometry geometry;
};

// Motion of a point that the previous camera had behind it: far outside of any image, yet a finite number.
constexpr double kBehind = 1e6;

struct PathTracer {
  quell::Out<quell::Radiance> color;
  quell::Out<quell::Albedo> albedo;
  quell::Out<quell::Normal> normal;
  quell::Out<quell::Depth> depth;
  quell::Out<quell::Position> position;
  quell::Out<quell::Motion> motion;
  quell::Out<quell::Id> id;
  quell::Out<quell::Radiance> emission, diffuse, specular;
  quell::Out<quell::Camera> camera;
  quell::Out<quell::Transforms> transforms;
  quell::Path scene{{{"quell:scenes/room.json", 22}}};
  int width = 480, height = 270;
  int spp = 1;
  int seed = 0;
  int max_bounces = 6;
  float clamp = 0;
  Jitter jitter = Jitter::center;
  Features features = Features::first;

  void describe(quell::Describe& d) {
    d.summary("Path-traces an animated scene file: noisy colour with exact feature buffers.");
    d.source(
        "Kajiya 1986, eq. 1; balance heuristic: Veach and Guibas 1995, eq. 12; samples: Burley 2020, Practical "
        "Hash-based Owen Scrambling");
    d.out(color, "color", "Radiance; the mean of spp samples, emitters and environment included.");
    d.out(albedo, "albedo",
          "Reflectance at the first hit, or behind it (features): base colour, for metals and mirrors that at normal "
          "incidence; 0 on emitters and misses.");
    d.out(normal, "normal",
          "Geometric normal at the first hit, or behind it (features), on the side that is seen; 0 for misses.");
    d.out(depth, "depth", "Depth of the first hit at the pixel's centre.");
    d.out(position, "position", "Position of the first hit at the pixel's centre.");
    d.out(
        motion, "motion",
        "Where the first hit was one frame earlier, by the motion of object and camera; misses move with the camera's "
        "rotation. 1e6 for points that were behind the camera. Defined for the first frame too, as the animation is.");
    d.out(id, "id", "Index of the object in the scene file.");
    d.out(emission, "emission", "Part of color that no surface has scattered: emitters and environment seen directly.");
    d.out(diffuse, "diffuse",
          "Part of color that the first surface scattered by its matte base. Emission, diffuse and specular make up "
          "color.");
    d.out(specular, "specular", "Part of color that the first surface scattered by gloss, mirror or glass.");
    d.out(camera, "camera", "Matrices of this frame.");
    d.out(transforms, "transforms", "Object to world in this frame, one matrix an object.");
    d.param(scene, "scene", "Scene file (JSON).");
    d.param(width, "width", "Width of the image, pixels.").range(1, 16384);
    d.param(height, "height", "Height of the image, pixels.").range(1, 16384);
    d.param(spp, "spp", "Samples per pixel.").range(1, 1 << 20);
    d.param(seed, "seed", "Chooses the noise; frames and pixels always differ.").range(0, 0x7fffffff);
    d.param(max_bounces, "max_bounces", "How many times a path may scatter; 1 is direct light only.").range(0, 1000);
    d.param(
         clamp, "clamp",
         "Largest channel that one sample may have, radiance; 0 is no limit. A limit removes fireflies and with them "
         "energy.")
        .range(0, 1e9);
    d.param(jitter, "jitter",
            "Where in the pixel colour is sampled: at its centre, like the features and like one sample of most "
            "renderers, or uniformly (anti-aliased).",
            {"center", "box"});
    d.param(features, "features",
            "Whose albedo and normal these are. first: those of the first hit, without noise. followed: those of the "
            "first surface on each sample's path that scatters widely, behind mirrors, glass and metal of a GGX alpha "
            "below 0.075, in the mean over the samples: noisy where metal is rough, as the denoising features of "
            "Cycles are.",
            {"first", "followed"});
  }

  void shapes(const quell_spec&, quell_shape* out) const {
    const Scene read = read_scene(file());
    for (int i = 0; i < camera.index; ++i) out[i].width = width, out[i].height = height;
    out[camera.index] = {16, 2, 1};
    out[transforms.index] = {16, int(read.objects.size()), 1};
  }

  Stage prepare(const quell_spec&) const { return Stage(file()); }

  void run(const quell::Tile& tile, const Stage& stage) const {
    const double now = double(tile.frame);
    const Camera view(stage.scene->camera, now, width, height),
        view_before(stage.scene->camera, now - 1, width, height);
    const Placement placement = stage.geometry.place(now), placement_before = stage.geometry.place(now - 1);
    const Lights lights(*stage.scene, stage.geometry, placement, now);
    // World now to world one frame earlier, for what is fixed to each object.
    std::vector<Mat> back;
    for (std::size_t i = 0; i < placement.to_world.size(); ++i)
      back.push_back(placement_before.to_world[i] * glm::inverse(placement.to_world[i]));
    const Moment moment{*stage.scene, stage.geometry, placement, lights};
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const Ray ray = view.ray(x + 0.5, y + 0.5);
        const auto hit = stage.geometry.intersect(placement, ray);
        write_features(tile, moment, x, y, ray, hit, view_before, back);
        const Traced light = estimate(moment, view, x, y, ray, hit, tile.frame);
        write(tile, color, x, y, light.all);
        write(tile, diffuse, x, y, light.diffuse);
        write(tile, specular, x, y, light.specular);
        if (features == Features::followed && hit) {
          write(tile, albedo, x, y, light.albedo);
          if (light.normal != Vec(0)) write(tile, normal, x, y, Rgb(glm::normalize(light.normal)));
        }
      }
    if (tile.x0 == 0 && tile.y0 == 0) write_tables(tile, view, placement);
  }

 private:
  std::string file() const { return scene.c_str(); }

  template <class T>
  static void write(const quell::Tile& tile, quell::Out<T> out, int x, int y, const Rgb& value) {
    for (int c = 0; c < 3; ++c) tile.row(out, c, y)[x] = value[c];
  }

  Traced estimate(const Moment& moment, const Camera& view, int x, int y, const Ray& center,
                  const std::optional<Hit>& center_hit, std::int64_t frame) const {
    constexpr std::uint32_t kPixelPlace = 0xffffffffu;  // a dimension that no path reaches
    glm::dvec3 all(0), matte(0), gloss(0), base(0), facing(0);
    for (int i = 0; i < spp; ++i) {
      const Sampler sampler(std::uint32_t(seed), frame, x, y, i);
      Traced value;
      if (jitter == Jitter::box) {
        const glm::vec2 u = sampler.pair(kPixelPlace);
        const Ray ray = view.ray(x + double(u.x), y + double(u.y));
        value = path_radiance(moment, ray, moment.geometry.intersect(moment.placement, ray), sampler, max_bounces);
      } else {
        value = path_radiance(moment, center, center_hit, sampler, max_bounces);
      }
      if (clamp > 0 && largest(value.all) > clamp) {
        const float scale = clamp / largest(value.all);
        value.all *= scale, value.diffuse *= scale, value.specular *= scale;
      }
      all += glm::dvec3(value.all), matte += glm::dvec3(value.diffuse), gloss += glm::dvec3(value.specular);
      base += glm::dvec3(value.albedo), facing += value.normal;
    }
    const double n = spp;
    return {Rgb(all / n), Rgb(matte / n), Rgb(gloss / n), Rgb(base / n), facing / n};
  }

  void write_features(const quell::Tile& tile, const Moment& moment, int x, int y, const Ray& ray,
                      const std::optional<Hit>& hit, const Camera& view_before, const std::vector<Mat>& back) const {
    Rgb base(0), light(0), facing(0), place(0);
    glm::dvec4 before(ray.direction, 0);
    if (hit) {
      const Material& m = moment.scene.materials[std::size_t(hit->material)];
      if (m.kind == Material::Kind::emitter)
        light = moment.lights.radiance(*hit, ray);
      else
        base = m.color.at(hit->point.texture);
      const Vec& n = hit->point.normal;
      facing = Rgb(glm::dot(n, ray.direction) > 0 ? -n : n);
      place = Rgb(hit->point.position);
      before = back[std::size_t(hit->object)] * glm::dvec4(hit->point.position, 1);
    } else {
      light = moment.scene.environment.at(glm::normalize(ray.direction));
    }
    write(tile, albedo, x, y, base);
    write(tile, emission, x, y, light);
    write(tile, normal, x, y, facing);
    write(tile, position, x, y, place);
    tile.row(depth, 0, y)[x] = hit ? float(hit->point.t) : quell::kFar;
    tile.bits(id, 0, y)[x] = hit ? std::uint32_t(hit->object) : quell::kNoId;
    glm::dvec2 pixel(0), moved(kBehind);
    if (view_before.project(before, pixel)) moved = glm::clamp(pixel - glm::dvec2(x + 0.5, y + 0.5), -kBehind, kBehind);
    tile.row(motion, 0, y)[x] = float(moved.x);
    tile.row(motion, 1, y)[x] = float(moved.y);
  }

  static void write_matrix(float* row, const Mat& m) {
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) row[4 * r + c] = float(m[c][r]);
  }

  void write_tables(const quell::Tile& tile, const Camera& view, const Placement& placement) const {
    write_matrix(tile.row(camera, 0, 0), view.world_to_view());
    write_matrix(tile.row(camera, 0, 1), view.world_to_screen());
    for (std::size_t i = 0; i < placement.to_world.size(); ++i)
      write_matrix(tile.row(transforms, 0, int(i)), placement.to_world[i]);
  }
};

}  // namespace
QUELL_PLUGIN("path_tracer", PathTracer)
