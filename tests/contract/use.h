// One use of a node, made from its table alone: parameters, typical inputs, and the weight nodes among them.
#pragma once

#include "core/image/image.h"
#include "core/plugin/node_type.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace quell::test {

struct Rect {
  int x0, y0, x1, y1;
  bool holds(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
};

struct Choices {
  int width = 67, height = 41;
  int any = QUELL_RADIANCE;              // what ports of type any are bound to
  bool optional = true;                  // optional ports are connected
  int only = -1;                         // input port: of the optional ones, this one alone is connected
  int listed = 2;                        // images on a list port
  bool missing = false;                  // every image is a delayed wire without a past
  std::vector<const NodeType*> weights;  // wired to each port that takes weights
};

struct Use {
  struct Port {
    int type = 0;  // quell_type, any bound
    std::vector<Image> images;
    std::vector<Use> weights;
  };
  const NodeType* type;
  Instance instance;
  std::vector<Port> in;
  bool missing = false;

  Use(const NodeType&, const Choices&);
  Use(Use&&) = default;
  Use copy() const;
  std::string name() const { return std::string(type->name()); }
  // quell_type of an output, any bound.
  int out_type(int port) const;

 private:
  explicit Use(const Use& other);
};

// A use as it crosses the plugin boundary. Throws std::runtime_error with the node's own words when it refuses.
class Bound {
 public:
  explicit Bound(const Use&);
  Bound(const Bound&) = delete;
  Bound& operator=(const Bound&) = delete;
  ~Bound();

  const std::vector<quell_shape>& shapes() const { return shapes_; }  // of the outputs
  bool exists(int output) const;
  // Size that tiles cover: that of the outputs that are pixels; of the first output when none is.
  quell_shape extent() const;
  void run(const Rect&, std::int64_t frame, const std::vector<quell_image>& out) const;
  void weigh(const quell_run&, float* exponent) const;

 private:
  void find_shapes();
  const Use& use_;
  std::vector<std::vector<quell_image>> views_;
  std::vector<std::vector<std::unique_ptr<Bound>>> weights_;
  std::vector<std::vector<quell_bound_weight>> bound_weights_;
  std::vector<quell_input> inputs_;
  std::vector<quell_shape> in_shapes_;
  std::vector<std::int32_t> counts_, in_channels_;
  std::vector<quell_shape> shapes_;
  void* resource_ = nullptr;
};

// True when tiles divide an output of this type; tables and values are written in whole by the tile that holds (0, 0).
bool is_pixels(int type);

}  // namespace quell::test
