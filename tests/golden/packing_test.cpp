// Two signals packed into one image and filtered under one set of weights, in a graph, against each filtered alone.
#include "core/graph/load.h"
#include "core/run/executor.h"
#include "tests/support/run_node.h"
#include "tests/support/scratch.h"
#include "tests/support/typical_input.h"

#include <gtest/gtest.h>
#include <quell/types.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace quell::test {
namespace {

constexpr char kGraph[] = R"({
  "quell": 1,
  "inputs": { "diffuse": "radiance", "specular": "radiance", "normal": "normal", "depth": "depth" },
  "nodes": {
    "by_normal":      { "type": "normal_weight", "in": { "normal": "normal" }, "set": { "power": 4 } },
    "by_depth":       { "type": "depth_weight", "in": { "depth": "depth" } },
    "alone_diffuse":  { "type": "atrous", "in": { "image": "diffuse", "weights": ["by_normal", "by_depth"] } },
    "alone_specular": { "type": "atrous", "in": { "image": "specular", "weights": ["by_normal", "by_depth"] } },
    "alone_depth":    { "type": "atrous", "in": { "image": "depth", "weights": ["by_normal", "by_depth"] } },
    "pack":           { "type": "pack", "in": { "images": ["diffuse", "specular", "depth"] } },
    "filter":         { "type": "atrous", "in": { "image": "pack", "weights": ["by_normal", "by_depth"] } },
    "out_diffuse":    { "type": "unpack", "in": { "image": "filter.image", "like": "diffuse" } },
    "out_specular":   { "type": "unpack", "in": { "image": "filter.image", "like": "specular" }, "set": { "first": 3 } },
    "out_depth":      { "type": "unpack", "in": { "image": "filter.image", "like": "depth" }, "set": { "first": 6 } }
  },
  "outputs": {
    "alone_diffuse": "alone_diffuse.image", "alone_specular": "alone_specular.image",
    "alone_depth": "alone_depth.image",
    "diffuse": "out_diffuse", "specular": "out_specular", "depth": "out_depth"
  }
})";

// One frame of images as a renderer gives them.
class OneFrame : public FrameSource {
 public:
  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t) const override { return true; }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t, std::span<const std::string> roles) override {
    std::vector<quell_shape> shapes;
    for (const auto& role : roles) shapes.push_back(typical_shape(roles_.at(role), kWidth, kHeight));
    return shapes;
  }
  void read(std::int64_t, std::span<const std::string> roles, std::span<const quell_image> into) override {
    for (std::size_t i = 0; i < roles.size(); ++i) {
      const auto image = typical_input(roles_.at(roles[i]), kWidth, kHeight, std::uint32_t(roles[i].size()));
      for (int c = 0; c < into[i].channels; ++c)
        for (int y = 0; y < kHeight; ++y) std::copy_n(image.row(c, y), kWidth, into[i].plane[c] + y * into[i].pitch);
    }
  }
  std::map<std::string, Repairs> repairs() const override { return {}; }

 private:
  static constexpr int kWidth = 150, kHeight = 43;
  std::vector<std::int64_t> frames_{1};
  std::map<std::string, int> roles_{
      {"diffuse", QUELL_RADIANCE}, {"specular", QUELL_RADIANCE}, {"normal", QUELL_NORMAL}, {"depth", QUELL_DEPTH}};
};

class Keep : public FrameSink {
 public:
  void write(std::int64_t, std::span<const quell_image> outputs) override {
    for (const auto& o : outputs) {
      auto& copy = images.emplace_back(o.width, o.height, o.channels);
      for (int c = 0; c < o.channels; ++c)
        for (int y = 0; y < o.height; ++y) std::copy_n(o.plane[c] + y * o.pitch, o.width, copy.row(c, y));
    }
  }
  std::vector<Image> images;
};

Graph graph_of(const std::string& text, std::string& messages) {
  const Scratch scratch;
  std::ofstream(scratch.path("packed.json")) << text;
  GraphRequest request;
  request.graph = scratch.path("packed.json");
  Diagnostics diagnostics;
  auto graph = load_graph(request, registry(), diagnostics);
  messages = diagnostics.format();
  return graph ? std::move(*graph) : Graph{};
}

// Sums run over the taps in one order however many planes there are, so not a bit differs.
TEST(Packing, ChangesNoBitOfASignal) {
  std::string messages;
  const auto graph = graph_of(kGraph, messages);
  ASSERT_EQ(messages, "");
  OneFrame source;
  Keep sink;
  run_graph(graph, source, sink, {});
  ASSERT_EQ(sink.images.size(), 6u);
  const auto diffuse = typical_input(QUELL_RADIANCE, 150, 43, 7);
  EXPECT_FALSE(same_bits(sink.images[0], diffuse)) << "the filter must do something";
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(graph.outputs[i].type, graph.outputs[i + 3].type);
    EXPECT_TRUE(same_bits(sink.images[i], sink.images[i + 3])) << graph.outputs[i + 3].name;
  }
}

TEST(Packing, UnpackSaysWhichChannelsThereAreNot) {
  std::string text = kGraph, messages;
  text.replace(text.find("\"first\": 6"), 10, "\"first\": 7");
  const auto graph = graph_of(text, messages);
  ASSERT_EQ(messages, "");
  OneFrame source;
  Keep sink;
  try {
    run_graph(graph, source, sink, {});
    FAIL() << "no error";
  } catch (const std::exception& e) {
    EXPECT_STREQ(e.what(),
                 "out_depth (unpack): channels 7 to 7 are asked for ('like' has 1), but 'image' has 7, counted from 0");
  }
}

}  // namespace
}  // namespace quell::test
