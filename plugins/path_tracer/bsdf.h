// How surfaces scatter light, in a frame whose z is the surface normal on the side of the viewer.
#pragma once

#include "path_tracer/scene.h"

namespace path_tracer {

struct Scattered {
  Dir direction{0};
  Rgb weight{0};       // f · |cosine| / pdf
  float pdf = 0;       // per solid angle; 0: the light is lost
  bool exact = false;  // a mirror direction: no other direction has any part in it
};

class Bsdf {
 public:
  // `outside`: the viewer is on the outward side of the surface, which glass needs to know.
  Bsdf(const Material&, const Rgb& color, bool outside);

  // Mirrors and clear glass scatter into single directions, which cannot be lit by sampling a lamp.
  bool exact() const { return kind_ == Material::Kind::mirror || kind_ == Material::Kind::glass; }
  // f · cosine for light from `to`, and the density with which `sample` picks `to`.
  Rgb evaluate(const Dir& from, const Dir& to) const;
  float pdf(const Dir& from, const Dir& to) const;
  // How much of `evaluate` is the matte base's, channel by channel; the rest is gloss.
  Rgb matte_share(const Dir& from, const Dir& to) const;
  // `choice` picks a lobe, `u` a direction in it.
  Scattered sample(const Dir& from, float choice, const glm::vec2& u) const;

 private:
  Rgb base(const Dir& from, const Dir& to) const;
  float coat_share(const Dir& from) const;
  float fresnel(float cosine) const;
  Rgb schlick(float cosine) const;
  float density(const Dir& half) const;
  float lambda(const Dir& v) const;
  float visible_pdf(const Dir& from, const Dir& to) const;
  Dir visible_half(const Dir& from, const glm::vec2& u) const;

  Material::Kind kind_;
  Rgb color_;
  float alpha_, ior_;
  bool outside_;
};

}  // namespace path_tracer
