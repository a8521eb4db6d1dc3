// Runs a graph written in a test over one frame of images.
#include "tests/support/run_graph.h"

#include "core/graph/load.h"
#include "core/run/executor.h"
#include "tests/support/paths.h"
#include "tests/support/run_node.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace quell::test {

namespace {

void copy(const quell_image& from, const quell_image& to) {
  for (int c = 0; c < from.channels; ++c)
    for (int y = 0; y < from.height; ++y)
      std::copy_n(from.plane[c] + y * from.pitch, from.width, to.plane[c] + y * to.pitch);
}

class OneFrame : public FrameSource {
 public:
  explicit OneFrame(const std::map<std::string, GraphImage>& inputs) : inputs_(inputs) {
    for (const auto& [name, input] : inputs) roles_[name] = input.type;
  }
  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t) const override { return true; }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t, std::span<const std::string> roles) override {
    std::vector<quell_shape> shapes;
    for (const auto& role : roles) shapes.push_back(inputs_.at(role).image->shape());
    return shapes;
  }
  void read(std::int64_t, std::span<const std::string> roles, std::span<const quell_image> into) override {
    for (std::size_t i = 0; i < roles.size(); ++i) copy(inputs_.at(roles[i]).image->view(), into[i]);
  }
  std::map<std::string, Repairs> repairs() const override { return {}; }

 private:
  const std::map<std::string, GraphImage>& inputs_;
  std::map<std::string, int> roles_;
  std::vector<std::int64_t> frames_{1};
};

class Keep : public FrameSink {
 public:
  explicit Keep(const Graph& graph) : graph_(graph) {}
  void write(std::int64_t, std::span<const quell_image> outputs) override {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      Image image(outputs[i].width, outputs[i].height, outputs[i].channels);
      copy(outputs[i], image.view());
      images.emplace(graph_.outputs[i].name, std::move(image));
    }
  }
  std::map<std::string, Image> images;

 private:
  const Graph& graph_;
};

}  // namespace

std::map<std::string, Image> run_graph_text(const std::string& text, const std::map<std::string, GraphImage>& inputs) {
  OneFrame source(inputs);
  GraphRequest request;
  request.graph = "test.json";
  request.text = text;
  request.graphs = std::filesystem::path(QUELL_TEST_SOURCE) / "graphs";
  request.roles = source.roles();
  Diagnostics diagnostics;
  const auto graph = load_graph(request, registry(), diagnostics);
  if (!graph || !diagnostics.format().empty()) throw std::runtime_error(diagnostics.format());
  Keep sink(*graph);
  run_graph(*graph, source, sink, {});
  return std::move(sink.images);
}

}  // namespace quell::test
