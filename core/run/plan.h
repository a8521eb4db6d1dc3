// Everything that can be decided before a frame is read: shapes, buffers, their places in memory and the nodes'
// resources.
#pragma once

#include "core/graph/graph.h"
#include "core/run/chains.h"

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace quell {

// What goes on while a frame is filtered. Each needs room of its own: the inputs of the next frame, the outputs of the
// last.
struct Overlap {
  bool reading = true, writing = true;
  int frames_in_flight() const { return 1 + int(reading) + int(writing); }
};

// One image that exists during a run: a graph input or a node's output.
struct PlannedValue {
  std::string name;  // "color", "blend.image"
  int type = 0;
  quell_shape shape{};
  bool exists = false;      // false: a weight, or an output whose `with` input is not connected
  int delay = 0;            // how many frames ago it is still read
  bool output = false;      // handed to the sink
  int slots = 0;            // > 0: a ring of its own, rotated by frame; 0: in the arena
  bool local = false;       // no more of it exists at a time than a band on each thread
  int first = 0, last = 0;  // steps of the order during which it lives
  std::size_t floats = 0;   // of one slot
  std::size_t offset = 0;   // in the arena, floats; of a local value in the memory of a band, planes
  // Of all slots.
  std::size_t bytes() const { return floats * sizeof(float) * std::size_t(slots > 0 ? slots : 1); }
};

// "ring of 3" frames, "a band", or the "steps 2-5" of the order during which it has a place in the arena.
std::string place_of(const PlannedValue&);

struct PlannedNode {
  std::vector<quell_shape> in;  // first image of each input port
  std::vector<int> in_count;
  std::vector<int> in_channels;  // of all images of each input port together
  std::vector<quell_reach> reach;
  int step = 1;           // rows apart that are read together
  int tiled = 0;          // output whose rectangle is cut into bands
  int max_row_reach = 0;  // rows above and below, except `anywhere`
  bool anywhere = false;
};

class Plan {
 public:
  // `inputs` has a shape for each graph input. Throws Error(Exit::usage) when sizes do not fit, Error(Exit::plugin)
  // when a node refuses them.
  Plan(const Graph&, std::span<const quell_shape> inputs, Overlap = {});

  const Graph& graph() const { return *graph_; }
  Overlap overlap() const { return overlap_; }
  const std::vector<PlannedValue>& values() const { return values_; }
  const std::vector<PlannedNode>& nodes() const { return nodes_; }
  const std::vector<Chain>& chains() const { return chains_; }
  std::size_t value_of(Source s) const {
    return s.node == Source::kInput ? std::size_t(s.port) : first_value_[std::size_t(s.node)] + std::size_t(s.port);
  }

  std::size_t arena_floats() const { return arena_floats_; }
  std::size_t ring_floats() const { return ring_floats_; }
  // Of the images that a node writes, the frames that a ring keeps of each included. What lives in the arena shares its
  // memory with others.
  std::size_t bytes_of(std::size_t node) const;
  std::size_t bytes() const { return (arena_floats_ + ring_floats_) * sizeof(float); }
  // What it would take without reuse of memory within a frame.
  std::size_t bytes_without_reuse() const;

  // Rows of a band for a chain on this many threads; `wanted` overrides (0: choose).
  int band_rows(const Chain&, int threads, int wanted) const;

  // The plan for people: order, reach, buffers, bytes.
  std::string describe() const;

 private:
  void list_values(std::span<const quell_shape> inputs);
  // One pass over the nodes; whether any shape changed. The settled one throws when a shape does, or is not known.
  bool shapes(bool settled);
  void lifetimes();
  void memory();
  void place_bands();

  const Graph* graph_;
  Overlap overlap_;
  std::vector<PlannedValue> values_;
  std::vector<PlannedNode> nodes_;
  std::vector<Chain> chains_;
  std::vector<std::size_t> chain_of_;
  std::vector<std::size_t> first_value_;
  std::size_t arena_floats_ = 0, ring_floats_ = 0;
};

// Resources made by the nodes' prepare, released with it.
class Resources {
 public:
  Resources(const Graph&, const Plan&);
  Resources(Resources&&) = default;
  const void* of(std::size_t node) const { return resources_[node].get(); }

 private:
  std::vector<std::unique_ptr<void, void (*)(void*)>> resources_;
};

}  // namespace quell
