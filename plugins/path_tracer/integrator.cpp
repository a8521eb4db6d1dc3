// The path loop.
#include "path_tracer/integrator.h"

#include "path_tracer/bsdf.h"

namespace path_tracer {

namespace {

// Dimension pairs of one path vertex.
enum Dimension : std::uint32_t { kDirection, kLobe, kLightPoint, kLight, kRoulette, kDimensions };

// Rays start beside the surface they leave, by more than single precision can confuse.
constexpr double kOffset = 2e-5;

Vec beside(const Vec& p, const Vec& normal, const Vec& towards) {
  const double size = kOffset * (1 + std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}));
  return p + normal * (glm::dot(normal, towards) < 0 ? -size : size);
}

// Whether features are looked for behind a surface: what the eye takes for a mirror. Cycles draws the line at the same
// GGX alpha (kernel/film/denoising_passes.h).
bool shows_what_is_behind(const Material& m) {
  constexpr float kNarrow = 0.075f;
  return m.kind == Material::Kind::mirror || m.kind == Material::Kind::glass ||
         (m.kind == Material::Kind::conductor && m.roughness * m.roughness < kNarrow);
}

}  // namespace

Traced path_radiance(const Moment& m, const Ray& primary, const std::optional<Hit>& first, const Sampler& sampler,
                     int max_bounces) {
  Traced sum;
  Rgb throughput(1), matte(0);  // the share of throughput that the first surface's base has let through
  bool found = false;           // the surface whose features these are
  Ray ray = primary;
  std::optional<Hit> hit = first;
  // The vertex before, and the density of the direction that led here; infinite where no lamp could have been sampled
  // instead.
  Receiver receiver{};
  float scattered_pdf = INFINITY;
  const auto share = [&](auto&& light_pdf) {
    return std::isinf(scattered_pdf) ? 1.0f : scattered_pdf / (scattered_pdf + light_pdf());
  };
  const auto add = [&](const Rgb& gain, const Rgb& diffuse) {
    sum.all += gain;
    sum.diffuse += gain * diffuse;
    sum.specular += gain * (Rgb(1) - diffuse);
  };
  for (int bounce = 0;; ++bounce) {
    const auto seen = [&](const Rgb& gain) { bounce ? add(gain, matte) : void(sum.all += gain); };
    if (!hit) {
      const Rgb sky = m.scene.environment.at(glm::normalize(ray.direction));
      if (largest(sky) > 0)
        seen(throughput * sky * share([&] { return m.lights.pdf_environment(receiver, ray.direction); }));
      break;
    }
    const Material& material = m.scene.materials[std::size_t(hit->material)];
    if (material.kind == Material::Kind::emitter) {
      const Rgb lamp = m.lights.radiance(*hit, ray);
      if (largest(lamp) > 0)
        seen(throughput * lamp * share([&] { return m.lights.pdf(receiver, ray.direction, *hit); }));
      break;
    }
    const Vec viewer = -glm::normalize(ray.direction);
    const bool outside = glm::dot(viewer, hit->point.normal) >= 0;
    const Vec normal = outside ? hit->point.normal : -hit->point.normal;
    const Frame frame(normal);
    const Rgb color = material.color.at(hit->point.texture);
    if (!found) {
      found = !shows_what_is_behind(material);
      sum.albedo = bounce ? sum.albedo * color : color;
      if (found || bounce == 0) sum.normal = normal;
    }
    if (bounce == max_bounces) break;

    const Bsdf bsdf(material, color, outside);
    const Dir from = frame.to_local(viewer);
    const std::uint32_t dimension = std::uint32_t(bounce) * kDimensions;

    if (!bsdf.exact()) {
      receiver =
          m.lights.receiver(beside(hit->point.position, normal, normal), normal, sampler.one(dimension + kLight));
      const LightSample s = m.lights.sample(receiver, sampler.pair(dimension + kLightPoint));
      const Dir to = frame.to_local(s.direction);
      if (s.pdf > 0 && to.z > 0 && largest(s.radiance) > 0) {
        const Rgb gain = throughput * bsdf.evaluate(from, to) * s.radiance / (s.pdf + bsdf.pdf(from, to));
        // The lamp itself must not count as being in the way.
        if (largest(gain) > 0 &&
            !m.geometry.occluded(m.placement, {receiver.position, s.direction}, s.distance * (1 - 1e-4)))
          add(gain, bounce ? matte : bsdf.matte_share(from, to));
      }
    }

    const Scattered s = bsdf.sample(from, sampler.one(dimension + kLobe), sampler.pair(dimension + kDirection));
    if (!(s.pdf > 0)) break;
    throughput *= s.weight;
    if (bounce == 0) matte = bsdf.matte_share(from, s.direction);
    if (!(largest(throughput) > 0)) break;
    if (bounce > 0) {
      const float survival = std::clamp(largest(throughput), 0.05f, 1.0f);
      if (sampler.one(dimension + kRoulette) >= survival) break;
      throughput /= survival;
    }
    scattered_pdf = s.exact ? INFINITY : s.pdf;
    const Vec out = frame.to_world(s.direction);
    ray = {beside(hit->point.position, normal, out), out};
    hit = m.geometry.intersect(m.placement, ray);
  }
  return sum;
}

}  // namespace path_tracer
