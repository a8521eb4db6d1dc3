// Runs a graph over a sequence inside a test.
#include "tests/support/run_sequence.h"

#include "core/graph/library.h"
#include "core/graph/params.h"
#include "core/run/node_source.h"
#include "core/sequence/file_sequence.h"
#include "core/sequence/sequence.h"
#include "tests/support/paths.h"
#include "tests/support/run_node.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace quell::test {

namespace {

class Keep : public FrameSink {
 public:
  explicit Keep(SequenceResult& result) : result_(result) {}
  void write(std::int64_t frame, std::span<const quell_image> outputs) override {
    auto& kept = result_.images[frame];
    for (const auto& o : outputs) {
      Image copy(o.width, o.height, o.channels);
      for (int c = 0; c < o.channels; ++c)
        for (int y = 0; y < o.height; ++y) std::copy_n(o.plane[c] + y * o.pitch, o.width, copy.row(c, y));
      kept.push_back(std::move(copy));
    }
  }

 private:
  SequenceResult& result_;
};

}  // namespace

SequenceResult run_sequence(const SequenceRun& run) {
  Diagnostics diagnostics;
  const auto fail = [&] { throw std::runtime_error(diagnostics.format()); };
  const std::string graphs = QUELL_TEST_SOURCE "/graphs";
  SequenceRequest request;
  request.path = run.sequence;
  if (!run.root.empty()) request.root = run.root;
  if (!run.frames.empty()) request.frames = run.frames;
  request.profiles = graphs + "/profiles";
  const auto sequence = load_sequence(request, diagnostics);
  if (!sequence) fail();

  GraphRequest wanted;
  wanted.graph = run.graph;
  wanted.graphs = graphs;
  wanted.edits = run.edits;
  wanted.roles = sequence->roles();
  const NodeType* source = sequence->source ? registry().find(sequence->source->type) : nullptr;
  if (sequence->source && !source) throw std::runtime_error("no node type " + sequence->source->type);
  if (source)
    for (const auto& port : source->outputs()) (*wanted.roles)[port.name] = port.type;
  const auto graph = load_graph(wanted, registry(), diagnostics);
  if (!graph) fail();

  std::vector<std::string> roles;
  for (const auto& input : graph->inputs) roles.push_back(input.name);
  std::unique_ptr<FrameSource> frames;
  if (source) {
    Instance instance(*source);
    Faults faults(diagnostics);
    const Library library(graphs, faults);
    if (sequence->source->set)
      for (const auto& member : sequence->source->set->members) {
        const int param = source->find_param(member.key);
        if (param < 0) throw std::runtime_error("the source has no parameter " + member.key);
        if (const auto problem = assign(instance, param, member.value, true, library); !problem.text.empty())
          throw std::runtime_error(member.key + ": " + problem.text);
      }
    for (const auto& [name, value] : run.source_ints) {
      const int param = source->find_param(name);
      if (param < 0) throw std::runtime_error("the source has no parameter " + name);
      instance.set_int(param, value);
    }
    frames = std::make_unique<NodeSource>(std::move(instance), sequence->frames, sequence->cuts, run.options.threads,
                                          nullptr);
  } else {
    frames = open_sequence(*sequence, roles, Missing::error, diagnostics);
    if (!frames) fail();
  }
  SequenceResult result;
  for (const auto& output : graph->outputs) result.names.push_back(output.name);
  Keep sink(result);
  result.report = run_graph(*graph, *frames, sink, run.options);
  return result;
}

std::string test_data() {
  const char* folder = std::getenv("QUELL_TEST_DATA");
  return folder ? folder : "";
}

}  // namespace quell::test
