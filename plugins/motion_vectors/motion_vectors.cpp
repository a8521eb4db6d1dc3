// Computes where each pixel was in the previous frame, from the matrices of cameras and objects.
#include <quell/node.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "motion_vectors/matrices.h"
#include "motion_vectors/motion_vectors_kernels.h"

namespace {

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
    }
    objects_.resize(now_ ? std::size_t(std::min(now_->height, then_->height)) : 1);
    known_.resize(objects_.size());
    if (!now_) objects_[0] = still_ ? at_rest() : moved(before_);
  }

  bool has_centre() const { return has_centre_; }

  // Makes sure that the objects of these pixels are known.
  void meet(const std::uint32_t* id, int x0, int x1) {
    for (int x = x0; x < x1; ++x)
      if (id[x] < known_.size() && !known_[id[x]]) {
        known_[id[x]] = true;
        objects_[id[x]] = journey_of(int(id[x]));
      }
  }

  void describe(quell::MotionRow& row) const {
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) row.rays[r][c] = rays_[c][r];
      row.centre[r] = centre_[r];
      row.view_z[r] = view_[r][2];
    }
    row.objects = objects_.data();
    row.count = std::uint32_t(objects_.size());
    row.each_its_own = now_ != nullptr;
    // What lies infinitely far away: the camera's rotation alone moves it.
    if (still_) row.background = at_rest();
    if (!still_ && has_centre_) row.background = moved(glm::dmat4(quell::directions(before_) * rays_), 2);
  }

 private:
  static quell::Journey at_rest() { return {quell::Past::rest, {}}; }
  // By rows 0, 1 and `last` of a matrix for column vectors.
  static quell::Journey moved(const glm::dmat4& m, int last = 3) {
    quell::Journey journey{quell::Past::moved, {}};
    for (int c = 0; c < 4; ++c)
      journey.matrix[0][c] = m[c][0], journey.matrix[1][c] = m[c][1], journey.matrix[2][c] = m[c][last];
    return journey;
  }

  // From the world now to the world then, moving with one object, and to the screen.
  quell::Journey journey_of(int id) const {
    if (quell::same_matrix(*now_, *then_, id)) return still_ ? at_rest() : moved(before_);
    return moved(before_ * quell::matrix(*then_, id) * glm::inverse(quell::matrix(*now_, id)));
  }

  glm::dmat4 view_, before_;
  bool still_, has_centre_;
  glm::dmat3 rays_{};
  glm::dvec3 centre_{};
  const quell_image *now_, *then_;
  std::vector<quell::Journey> objects_;
  std::vector<char> known_;
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
    if (missing) return clear(tile);
    quell::MotionRow row{};
    movement.describe(row);
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int c = 0; c < 3 && tile.has(position); ++c) row.position[c] = tile.row(position, c, y);
      if (tile.has(depth)) row.depth = tile.row(depth, 0, y);
      if (tile.has(id)) row.id = tile.bits(id, 0, y);
      if (objects) movement.meet(row.id, tile.x0, tile.x1);
      for (int c = 0; c < 2; ++c) row.motion[c] = tile.row(motion, c, y);
      row.y = y;
      quell::motion_row(row, tile.x0, tile.x1);
    }
  }

 private:
  void clear(const quell::Tile& tile) const {
    for (int c = 0; c < 2; ++c)
      for (int y = tile.y0; y < tile.y1; ++y)
        std::fill(tile.row(motion, c, y) + tile.x0, tile.row(motion, c, y) + tile.x1, quell::kNoMotion);
  }
};

}  // namespace
QUELL_PLUGIN("motion_vectors", MotionVectors)
