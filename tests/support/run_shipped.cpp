// Loads shipped graphs and runs them.
#include "tests/support/run_shipped.h"

#include <filesystem>
#include <stdexcept>

#include "core/run/executor.h"
#include "tests/support/paths.h"
#include "tests/support/run_node.h"

namespace quell::test {

namespace {

class Callback : public FrameSink {
 public:
  Callback(const Graph& graph, const std::function<void(std::int64_t, const FrameOutputs&)>& use)
      : graph_(graph), use_(use) {}
  void write(std::int64_t frame, std::span<const quell_image> images) override {
    FrameOutputs outputs;
    for (std::size_t i = 0; i < images.size(); ++i) outputs[graph_.outputs[i].name] = images[i];
    use_(frame, outputs);
  }

 private:
  const Graph& graph_;
  const std::function<void(std::int64_t, const FrameOutputs&)>& use_;
};

}  // namespace

Graph shipped_graph(const std::string& name, std::vector<Edit> edits, const std::map<std::string, int>* roles) {
  GraphRequest request;
  request.graph = name;
  request.graphs = std::filesystem::path(QUELL_TEST_SOURCE) / "graphs";
  request.edits = std::move(edits);
  if (roles) request.roles = *roles;
  Diagnostics diagnostics;
  auto graph = load_graph(request, registry(), diagnostics);
  if (!graph || !diagnostics.format().empty()) throw std::runtime_error(diagnostics.format());
  return std::move(*graph);
}

void run_shipped(const std::string& name, std::vector<Edit> edits, FrameSource& source,
                 const std::function<void(std::int64_t, const FrameOutputs&)>& use) {
  const Graph graph = shipped_graph(name, std::move(edits), &source.roles());
  Callback sink(graph, use);
  run_graph(graph, source, sink, {});
}

}  // namespace quell::test
