// Readers of matrix files, and the little algebra that conversions of space need.
#include "core/sequence/matrices.h"

#include "core/json/json.h"
#include "core/report/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace quell {

namespace {

constexpr int kMostObjects = 1 << 16;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw Error(Exit::input, fmt::format("{}: {}", path, why));
}

// GLM keeps columns.
glm::dmat4 to_glm(const Matrix& m) { return glm::transpose(glm::make_mat4(m.data())); }
Matrix from_glm(const glm::dmat4& m) {
  Matrix out;
  const glm::dmat4 rows = glm::transpose(m);
  std::copy_n(glm::value_ptr(rows), 16, out.begin());
  return out;
}

}  // namespace

Matrix operator*(const Matrix& a, const Matrix& b) { return from_glm(to_glm(a) * to_glm(b)); }

bool invert(const Matrix& m, Matrix& inverse) {
  inverse = from_glm(glm::inverse(to_glm(m)));
  return std::ranges::all_of(inverse, [](double v) { return std::isfinite(v); });
}

FrameMatrices read_games202_matrices(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  std::vector<unsigned char> bytes;
  // One byte more than the largest file that there can be.
  constexpr std::size_t most = 4 + 64 * (std::size_t(kMostObjects) + 2) + 1;
  char block[4096];
  while (bytes.size() < most && (file.read(block, sizeof block), file.gcount() > 0))
    bytes.insert(bytes.end(), block, block + file.gcount());
  const auto word = [&](std::size_t at) {
    return std::uint32_t(bytes[at]) | std::uint32_t(bytes[at + 1]) << 8 | std::uint32_t(bytes[at + 2]) << 16 |
           std::uint32_t(bytes[at + 3]) << 24;
  };
  if (bytes.size() < 4) refuse(path, fmt::format("is no matrix file: it has {} bytes", bytes.size()));
  const std::uint32_t count = word(0);
  if (count > std::uint32_t(kMostObjects))
    refuse(path, fmt::format("is no matrix file: it claims {} objects", std::int32_t(count)));
  const std::size_t expected = 4 + 64 * (std::size_t(count) + 2);
  if (bytes.size() != expected)
    refuse(path, fmt::format("has {} bytes in place of the {} that {} objects and a camera take", bytes.size(),
                             expected, count));
  const auto matrix = [&](std::size_t index) {
    Matrix m;
    for (std::size_t i = 0; i < 16; ++i) {
      m[i] = double(std::bit_cast<float>(word(4 + 64 * index + 4 * i)));
      if (!std::isfinite(m[i])) refuse(path, fmt::format("matrix {} holds a number that is not finite", index));
    }
    return m;
  };
  FrameMatrices out;
  for (std::size_t i = 0; i < count; ++i) out.objects.push_back(matrix(i));
  out.world_to_view = matrix(count);
  out.world_to_screen = matrix(count + 1);
  return out;
}

namespace {

// Takes a document apart; what does not fit is refused with its place.
class TableReader {
 public:
  TableReader(const std::string& path, const Sources& sources) : path_(path), sources_(sources) {}

  [[noreturn]] void refuse_at(const Json& json, const std::string& why) const {
    const std::string place = sources_.place(json.position);
    throw Error(Exit::input, fmt::format("{}: {}", place.empty() ? path_ : place, why));
  }
  const Json& member(const Json& object, const char* key, Json::Kind kind, const char* what) const {
    const Json* json = object.find(key);
    if (!json) refuse_at(object, fmt::format("has no '{}'", key));
    if (!json->is(kind)) refuse_at(*json, fmt::format("'{}' is {} in place of {}", key, json->kind_name(), what));
    return *json;
  }
  Matrix matrix(const Json& json) const {
    Matrix m{};
    if (!json.is(Json::Kind::list) || json.items.size() != 4) refuse_at(json, "a matrix is a list of four rows");
    for (std::size_t i = 0; i < 4; ++i) {
      const Json& row = json.items[i];
      if (!row.is(Json::Kind::list) || row.items.size() != 4)
        refuse_at(row, "a row of a matrix is a list of four numbers");
      for (std::size_t k = 0; k < 4; ++k) {
        if (!row.items[k].is_number()) refuse_at(row.items[k], row.items[k].shown() + " is no number");
        m[4 * i + k] = row.items[k].number;
      }
    }
    return m;
  }

 private:
  const std::string& path_;
  const Sources& sources_;
};

}  // namespace

CameraTable::CameraTable(const std::string& path) : path_(path) {
  Diagnostics diagnostics;
  const auto document = parse_json_file(path, diagnostics);
  if (!document) {
    std::string text = diagnostics.format();
    if (!text.empty() && text.back() == '\n') text.pop_back();
    throw Error(Exit::input, text);
  }
  const TableReader reader(path, diagnostics.sources);
  const double width = reader.member(*document, "width", Json::Kind::integer, "a whole number").number;
  const double height = reader.member(*document, "height", Json::Kind::integer, "a whole number").number;
  // Turns the camera to look down +z; NDC to pixels, the depth to [0,1].
  constexpr Matrix turn = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};
  const Matrix viewport = {width / 2, 0, 0, width / 2, 0, -height / 2, 0, height / 2, 0, 0, 0.5, 0.5, 0, 0, 0, 1};
  for (const Json& frame : reader.member(*document, "frames", Json::Kind::list, "a list").items) {
    const std::int64_t number = reader.member(frame, "frame", Json::Kind::integer, "a whole number").integer;
    const Matrix camera = reader.matrix(reader.member(frame, "world_to_camera", Json::Kind::list, "a matrix"));
    const Matrix projection = reader.matrix(reader.member(frame, "projection", Json::Kind::list, "a matrix"));
    FrameMatrices m;
    m.world_to_view = turn * camera;
    m.world_to_screen = viewport * projection * camera;
    if (const Json* objects = frame.find("objects")) {
      for (const auto& [key, key_position, value] : objects->members) {
        int id = -1;
        const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), id);
        if (error != std::errc() || end != key.data() + key.size() || id < 0 || id >= kMostObjects)
          reader.refuse_at(value, fmt::format("'{}' is no object number from 0 to {}", key, kMostObjects - 1));
        if (m.objects.size() <= std::size_t(id)) m.objects.resize(std::size_t(id) + 1, kIdentity);
        m.objects[std::size_t(id)] = reader.matrix(value);
      }
    }
    frames_.emplace_back(number, std::move(m));
  }
}

bool CameraTable::has(std::int64_t frame) const {
  return std::ranges::find(frames_, frame, &std::pair<std::int64_t, FrameMatrices>::first) != frames_.end();
}

const FrameMatrices& CameraTable::at(std::int64_t frame) const {
  const auto found = std::ranges::find(frames_, frame, &std::pair<std::int64_t, FrameMatrices>::first);
  if (found == frames_.end()) refuse(path_, fmt::format("has no frame {}", frame));
  return found->second;
}

quell_shape camera_shape() { return {16, 2, 1}; }
quell_shape transforms_shape(const FrameMatrices& m) { return {16, std::max(1, int(m.objects.size())), 1}; }

namespace {

void store_row(const Matrix& m, const quell_image& image, int row) {
  for (int i = 0; i < 16; ++i) image.plane[0][row * image.pitch + i] = float(m[std::size_t(i)]);
}

}  // namespace

void store_camera(const FrameMatrices& m, const quell_image& image) {
  store_row(m.world_to_view, image, 0);
  store_row(m.world_to_screen, image, 1);
}

void store_transforms(const FrameMatrices& m, const quell_image& image) {
  if (m.objects.empty()) store_row(kIdentity, image, 0);
  for (std::size_t i = 0; i < m.objects.size(); ++i) store_row(m.objects[i], image, int(i));
}

}  // namespace quell
