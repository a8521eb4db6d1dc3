// Computes where each pixel was in the previous frame, from the matrices of cameras and objects.
#include <quell/node.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include "motion_vectors/matrices.h"

namespace {

// Motion where there is none to be known. It leads out of any image, so the pixel counts as disoccluded.
constexpr float kNoMotion = 1e6f;
// Nearer to the camera plane than this (or behind it), nothing projects.
constexpr double kLeastW = 1e-6;

constexpr int kWorldToView = 0, kWorldToScreen = 1;  // the rows of a camera table

// What a frame's matrices say about motion; lives as long as a tile.
class Movement {
 public:
  Movement(const quell_image& camera, const quell_image& before, const quell_image* now, const quell_image* then)
      : view_(quell::matrix(camera, kWorldToView)),
        before_(quell::matrix(before, kWorldToScreen)),
        still_(quell::same_matrix(camera, before, kWorldToScreen)),
        now_(now),
        then_(then) {
    const auto screen = quell::matrix(camera, kWorldToScreen);
    const auto rays = quell::directions(screen);
    has_centre_ = glm::determinant(rays) != 0;
    if (has_centre_) {
      rays_ = glm::inverse(rays);
      centre_ = -(rays_ * glm::dvec3(screen[3][0], screen[3][1], screen[3][3]));
      turn_ = quell::directions(before_) * rays_;
    }
    if (now_) steps_.resize(std::size_t(std::min(now_->height, then_->height)));
  }

  bool has_centre() const { return has_centre_; }

  // The world position that pixel (x, y) shows at this depth.
  glm::dvec3 position(int x, int y, double depth) const {
    const auto ray = rays_ * glm::dvec3(x + 0.5, y + 0.5, 1);
    const double along = view_[0][2] * ray.x + view_[1][2] * ray.y + view_[2][2] * ray.z;
    return centre_ + ray * (depth / along);
  }

  // Homogeneous pixels, one frame earlier, of a point on an object; nothing where the object has no past.
  std::optional<glm::dvec3> point(const glm::dvec3& p, std::uint32_t id) {
    glm::dvec4 then(p, 1);
    if (now_) {
      if (id >= steps_.size()) return {};
      const auto& step = step_of(id);
      if (step.moves) then = step.matrix * then;
    }
    const auto s = before_ * then;
    return glm::dvec3(s.x, s.y, s.w);
  }

  // The same for what lies infinitely far behind pixel (x, y): the camera's rotation alone moves it.
  glm::dvec3 background(int x, int y) const { return turn_ * glm::dvec3(x + 0.5, y + 0.5, 1); }

  // Neither camera nor object moves, so the motion is 0 to the bit.
  bool at_rest(std::uint32_t id) {
    if (!still_) return false;
    return !now_ || (id < steps_.size() && !step_of(id).moves);
  }
  bool still() const { return still_; }

 private:
  // From the world now to the world then, moving with one object.
  struct Step {
    bool known = false, moves = false;
    glm::dmat4 matrix;
  };

  const Step& step_of(std::uint32_t id) {
    auto& step = steps_[id];
    if (!step.known) {
      step.known = true;
      step.moves = !quell::same_matrix(*now_, *then_, int(id));
      if (step.moves) step.matrix = quell::matrix(*then_, int(id)) * glm::inverse(quell::matrix(*now_, int(id)));
    }
    return step;
  }

  glm::dmat4 view_, before_;
  bool still_, has_centre_;
  glm::dmat3 rays_{}, turn_{};
  glm::dvec3 centre_{};
  const quell_image *now_, *then_;
  std::vector<Step> steps_;
};

struct MotionVectors {
  quell::In<quell::Position> position;
  quell::In<quell::Depth> depth;
  quell::In<quell::Id> id;
  quell::In<quell::Camera> camera, camera_before;
  quell::In<quell::Transforms> transforms, transforms_before;
  quell::Out<quell::Motion> motion;

  void describe(quell::Describe& d) {
    d.summary(
        "Motion from the matrices of cameras and rigid objects: each surface point goes back with its object and is "
        "projected by the previous camera; a miss lies at infinity and goes back with the camera's rotation.");
    d.source("GAMES202 lecture 12: screen = P(t−1)·V(t−1)·M(t−1)·M(t)⁻¹·position.");
    d.in(position, "position", "World position. Without it, it is rebuilt from depth.").optional();
    d.in(depth, "depth", "Depth; 1e30 is a miss. Needed where position is not connected.").optional();
    d.in(id, "id", "Object number, the index into transforms; 0xFFFFFFFF is a miss.").optional();
    d.in(camera, "camera", "This frame's camera.").anywhere();
    d.in(camera_before, "camera_before", "The previous frame's camera: a delayed wire.").anywhere();
    d.in(transforms, "transforms", "Object-to-world matrices of this frame; without them, objects stand still.")
        .optional()
        .anywhere();
    d.in(transforms_before, "transforms_before", "Those of the previous frame: a delayed wire.").optional().anywhere();
    d.out(motion, "motion",
          "Pixels, previous − current. 1e6, which leads out of any image, where the point was behind the camera, its "
          "object has no past matrix, or the previous camera is missing.");
  }

  void shapes(const quell_spec& spec, quell_shape*) const {
    const auto has = [&](int port) { return spec.in_count[port] > 0; };
    if (!has(position.index) && !has(depth.index)) throw std::runtime_error("connect position or depth");
    if (has(transforms.index) != has(transforms_before.index))
      throw std::runtime_error("transforms and transforms_before go together: one is connected and the other is not");
    if (has(transforms.index) && !has(id.index))
      throw std::runtime_error("transforms need id, to tell which matrix moves a pixel");
  }

  void run(const quell::Tile& tile) const {
    const bool objects = tile.has(transforms);
    const bool missing = tile.missing(camera_before) || tile.missing(transforms_before);
    Movement movement(tile[camera], tile[camera_before], objects ? &tile[transforms] : nullptr,
                      objects ? &tile[transforms_before] : nullptr);
    if (!movement.has_centre() && !tile.has(position) && !missing)
      throw std::runtime_error(
          "a camera without a centre (orthographic) cannot rebuild positions from depth: connect position");
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const auto m = missing ? nowhere() : at_pixel(tile, movement, x, y);
        tile.row(motion, 0, y)[x] = m.x;
        tile.row(motion, 1, y)[x] = m.y;
      }
  }

 private:
  static glm::vec2 nowhere() { return {kNoMotion, kNoMotion}; }

  glm::vec2 at_pixel(const quell::Tile& tile, Movement& movement, int x, int y) const {
    const std::uint32_t object = tile.has(id) ? tile.bits(id, 0, y)[x] : 0;
    if (is_miss(tile, x, y, object)) {
      if (movement.still()) return {0, 0};
      return movement.has_centre() ? difference(movement.background(x, y), x, y) : nowhere();
    }
    if (movement.at_rest(object)) return {0, 0};
    const auto then = movement.point(position_of(tile, movement, x, y), object);
    return then ? difference(*then, x, y) : nowhere();
  }

  bool is_miss(const quell::Tile& tile, int x, int y, std::uint32_t object) const {
    if (tile.has(id)) return object == quell::kNoId;
    if (tile.has(depth)) return tile.row(depth, 0, y)[x] >= 0.5f * quell::kFar;
    return tile.row(position, 0, y)[x] == 0 && tile.row(position, 1, y)[x] == 0 && tile.row(position, 2, y)[x] == 0;
  }

  glm::dvec3 position_of(const quell::Tile& tile, const Movement& movement, int x, int y) const {
    if (!tile.has(position)) return movement.position(x, y, tile.row(depth, 0, y)[x]);
    return {tile.row(position, 0, y)[x], tile.row(position, 1, y)[x], tile.row(position, 2, y)[x]};
  }

  static glm::vec2 difference(const glm::dvec3& screen, int x, int y) {
    if (!(screen.z > kLeastW)) return nowhere();
    const glm::dvec2 m(screen.x / screen.z - (x + 0.5), screen.y / screen.z - (y + 0.5));
    // Written so that NaN, from a matrix without an inverse, leads out of the image too.
    return std::abs(m.x) < kNoMotion && std::abs(m.y) < kNoMotion ? glm::vec2(m) : nowhere();
  }
};

}  // namespace
QUELL_PLUGIN("motion_vectors", MotionVectors)
