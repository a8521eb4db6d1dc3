// Runs one node of a plugin on images, outside any graph: what oracle tests are written with.
#pragma once

#include "core/image/image.h"
#include "core/plugin/registry.h"

#include <cstdint>
#include <deque>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace quell::test {

// All plugins of this build; of the folder that QUELL_TEST_PLUGINS names in the environment, where it does.
Registry& registry();

using ParamValue = std::variant<bool, int, float, std::vector<float>, std::string>;  // text also names a choice

// A configured node with its inputs bound. Images are borrowed: they must outlive the node.
class Node {
 public:
  explicit Node(std::string_view type);

  Node& set(std::string_view param, ParamValue);
  Node& in(std::string_view port, const Image&);  // appends for a list port
  Node& in_missing(std::string_view port,
                   const Image&);                 // a delayed wire without a past; the image is what it reads as
  Node& in(std::string_view port, Node& weight);  // a weight node, for a port of type weight
  Node& frame(std::int64_t number);
  // Rows per tile (0: one tile for the whole image) and columns per tile.
  Node& tiles(int rows, int columns = 0);

  // Runs it over its whole output and gives one image an output port (empty where an output does not exist).
  std::vector<Image> run();
  // The first output, or the named one.
  Image run(std::string_view output);

  const NodeType& type() const { return *type_; }
  const quell_bound_weight& bound();
  std::vector<quell_shape> shapes() const;

 private:
  const NodeType* type_;
  Instance instance_;
  std::vector<std::vector<quell_image>> images_;
  std::vector<std::vector<Node*>> weights_;
  std::int64_t frame_ = 0;
  int rows_ = 0, columns_ = 0;
  // Kept for `bound`.
  std::vector<quell_input> inputs_;
  quell_bound_weight bound_{};
};

// Deterministic values for tests: uniform in [low, high).
Image noise_image(int width, int height, int channels, std::uint32_t seed, float low = 0.0f, float high = 1.0f);
Image constant_image(int width, int height, int channels, float value);
// Unit normals that vary smoothly, with misses (0,0,0) where `misses`.
Image normal_image(int width, int height, std::uint32_t seed, bool misses = false);
// Whether two images have one shape and the same bits.
bool same_bits(const Image&, const Image&);

}  // namespace quell::test
