// Matrices that come with a frame: the camera's two, and one an object.
#pragma once

#include <quell/abi.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace quell {

using Matrix = std::array<double, 16>;  // row-major, for column vectors

constexpr Matrix kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Matrix operator*(const Matrix&, const Matrix&);
// Singular matrices have no inverse: false.
bool invert(const Matrix&, Matrix& inverse);

struct FrameMatrices {
  Matrix world_to_view = kIdentity;    // x right, y up, z forward
  Matrix world_to_screen = kIdentity;  // pixels, y down, centres at +0.5, to be divided by w
  std::vector<Matrix> objects;         // object to world, by id
};

// The file of GAMES202 homework 5: int32 n, then n + 2 float32 4x4 (objects, world to camera, world to screen),
// little-endian. Throws Error(Exit::input).
FrameMatrices read_games202_matrices(const std::string& path);

// A JSON file for a whole sequence: {"width", "height", "frames": [{"frame", "world_to_camera", "projection",
// "objects":
// {"id": matrix}}]}, matrices as lists of four rows, an OpenGL camera (looks down -z, NDC in [-1,1], y up). Ids that
// are not listed have the identity. Throws Error(Exit::input) for a file that is not so, or lacks the frame.
class CameraTable {
 public:
  explicit CameraTable(const std::string& path);
  bool has(std::int64_t frame) const;
  const FrameMatrices& at(std::int64_t frame) const;

 private:
  std::string path_;
  std::vector<std::pair<std::int64_t, FrameMatrices>> frames_;
};

// As images of the types `camera` (2 rows) and `transforms` (one row an object, at least one).
quell_shape camera_shape();
quell_shape transforms_shape(const FrameMatrices&);
void store_camera(const FrameMatrices&, const quell_image&);
void store_transforms(const FrameMatrices&, const quell_image&);

}  // namespace quell
