// Lambert, GGX with Smith's height-correlated shadowing, a dielectric coat over Lambert, mirror and clear glass.
//
// GGX: Walter et al. 2007; Heitz 2014, "Understanding the Masking-Shadowing Function", eq. 72 (Lambda) and 99 (G2);
// visible normals are drawn after Heitz 2018, "Sampling the GGX Distribution of Visible Normals", appendix A.
#include "path_tracer/bsdf.h"

namespace path_tracer {

namespace {

float squared(float x) { return x * x; }

Dir cosine_direction(const glm::vec2& u) {
  const float r = std::sqrt(u.x), phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0f, 1 - u.x))};
}

}  // namespace

Bsdf::Bsdf(const Material& m, const Rgb& color, bool outside)
    : kind_(m.kind), color_(color), alpha_(squared(m.roughness)), ior_(m.ior), outside_(outside) {}

// Unpolarised Fresnel reflectance of a dielectric; `cosine` on the side that light comes from.
float Bsdf::fresnel(float cosine) const {
  const float eta = outside_ ? ior_ : 1 / ior_;
  const float sine2 = (1 - squared(cosine)) / squared(eta);
  if (sine2 >= 1) return 1;
  const float inner = std::sqrt(1 - sine2);
  const float parallel = (eta * cosine - inner) / (eta * cosine + inner);
  const float across = (cosine - eta * inner) / (cosine + eta * inner);
  return 0.5f * (squared(parallel) + squared(across));
}

Rgb Bsdf::schlick(float cosine) const {
  const float m = std::clamp(1 - cosine, 0.0f, 1.0f);
  return color_ + (Rgb(1) - color_) * (squared(squared(m)) * m);
}

float Bsdf::density(const Dir& half) const {
  const float a2 = squared(alpha_);
  // 1 - z² as x² + y²: the difference would cancel near the normal.
  const float d = squared(half.x) + squared(half.y) + a2 * squared(half.z);
  return a2 / (kPi * squared(d));
}

float Bsdf::lambda(const Dir& v) const {
  const float tangent2 = (squared(v.x) + squared(v.y)) / squared(v.z);
  return 0.5f * (std::sqrt(1 + squared(alpha_) * tangent2) - 1);
}

// Density of the mirror direction about a visible normal: G1 D / (4 cosine).
float Bsdf::visible_pdf(const Dir& from, const Dir& to) const {
  return density(glm::normalize(from + to)) / (4 * from.z * (1 + lambda(from)));
}

Dir Bsdf::visible_half(const Dir& from, const glm::vec2& u) const {
  const Dir v = glm::normalize(Dir(alpha_ * from.x, alpha_ * from.y, from.z));
  const float across = squared(v.x) + squared(v.y);
  const Dir s = across > 0 ? Dir(-v.y, v.x, 0) / std::sqrt(across) : Dir(1, 0, 0), t = glm::cross(v, s);
  const float r = std::sqrt(u.x), phi = 2 * kPi * u.y, x = r * std::cos(phi), bend = 0.5f * (1 + v.z);
  const float y = (1 - bend) * std::sqrt(std::max(0.0f, 1 - x * x)) + bend * r * std::sin(phi);
  const Dir n = x * s + y * t + std::sqrt(std::max(0.0f, 1 - x * x - y * y)) * v;
  return glm::normalize(Dir(alpha_ * n.x, alpha_ * n.y, std::max(1e-6f, n.z)));
}

// How often a plastic surface is sampled by its coat; the rest goes to its base.
float Bsdf::coat_share(const Dir& from) const {
  const float coat = fresnel(from.z), base = (1 - coat) * largest(color_);
  return std::clamp(coat / std::max(coat + base, 1e-6f), 0.05f, 0.95f);
}

// A plastic surface's base: what the coat lets in and out again; reciprocal, and never more than arrives.
Rgb Bsdf::base(const Dir& from, const Dir& to) const {
  const float through = (1 - fresnel(from.z)) * (1 - fresnel(to.z));
  return color_ * (through * to.z / kPi);
}

Rgb Bsdf::evaluate(const Dir& from, const Dir& to) const {
  if (exact() || from.z <= 0 || to.z <= 0) return Rgb(0);
  if (kind_ == Material::Kind::diffuse) return color_ * (to.z / kPi);
  const Dir half = glm::normalize(from + to);
  const float gloss = density(half) / (4 * from.z * (1 + lambda(from) + lambda(to)));
  const float cosine = std::min(1.0f, glm::dot(from, half));
  if (kind_ == Material::Kind::conductor) return schlick(cosine) * gloss;
  return Rgb(fresnel(cosine) * gloss) + base(from, to);
}

Rgb Bsdf::matte_share(const Dir& from, const Dir& to) const {
  if (kind_ == Material::Kind::diffuse) return Rgb(1);
  if (kind_ != Material::Kind::plastic) return Rgb(0);
  return base(from, to) / glm::max(evaluate(from, to), Rgb(1e-30f));
}

float Bsdf::pdf(const Dir& from, const Dir& to) const {
  if (exact() || from.z <= 0 || to.z <= 0) return 0;
  if (kind_ == Material::Kind::diffuse) return to.z / kPi;
  const float gloss = visible_pdf(from, to);
  if (kind_ == Material::Kind::conductor) return gloss;
  const float share = coat_share(from);
  return share * gloss + (1 - share) * to.z / kPi;
}

Scattered Bsdf::sample(const Dir& from, float choice, const glm::vec2& u) const {
  if (from.z <= 0) return {};
  const Dir mirrored(-from.x, -from.y, from.z);
  if (kind_ == Material::Kind::mirror) return {mirrored, schlick(from.z), 1, true};
  if (kind_ == Material::Kind::glass) {
    if (choice < fresnel(from.z)) return {mirrored, Rgb(1), 1, true};
    // Radiance grows by the square of the index on entering and shrinks as much on leaving; both are left out.
    const float eta = outside_ ? 1 / ior_ : ior_;
    const float inner = std::sqrt(std::max(0.0f, 1 - squared(eta) * (1 - squared(from.z))));
    return {glm::normalize(Dir(-from.x * eta, -from.y * eta, -inner)), color_, 1, true};
  }
  Scattered s;
  const bool coat =
      kind_ == Material::Kind::conductor || (kind_ == Material::Kind::plastic && choice < coat_share(from));
  if (coat) {
    const Dir half = visible_half(from, u);
    s.direction = 2 * glm::dot(from, half) * half - from;
  } else {
    s.direction = cosine_direction(u);
  }
  s.pdf = pdf(from, s.direction);
  if (!(s.pdf > 0)) return {};
  s.weight = evaluate(from, s.direction) / s.pdf;
  return s;
}

}  // namespace path_tracer
