// A graph on the host's own executor, frame by frame, on frames made in memory: what `quell run` filters with, without
// files.
#pragma once

#include "core/bench/synthetic_source.h"
#include "core/graph/load.h"
#include "core/run/session.h"
#include "tests/bench/turns.h"
#include "tests/support/paths.h"
#include "tests/support/run_node.h"

#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace quell::bench {

// An installed graph, or `text` in place of a file.
inline Graph load(const std::string& name, const std::vector<std::string>& set = {},
                  std::optional<std::string> text = {}) {
  GraphRequest request;
  request.graph = name, request.text = std::move(text);
  request.graphs = QUELL_TEST_SOURCE "/graphs";
  for (const auto& value : set) request.edits.push_back({Edit::Kind::set, value});
  Diagnostics diagnostics;
  auto graph = load_graph(request, test::registry(), diagnostics);
  if (!graph) {
    std::cerr << diagnostics.format();
    std::exit(1);
  }
  return std::move(*graph);
}

// One at a time: the number of threads is the process's.
class HostGraph {
 public:
  HostGraph(Graph graph, int width, int height, int threads)
      : graph_(std::move(graph)), source_(graph_, width, height, 1 << 20), workers_(threads) {
    for (const auto& input : graph_.inputs) roles_.push_back(input.name);
    session_ = std::make_unique<Session>(graph_, source_.shapes(0, roles_), workers_, RunOptions{});
    times_.resize(graph_.nodes.size());
    read();
  }

  const Graph& graph() const { return graph_; }
  const Plan& plan() const { return session_->plan(); }
  // Reads the inputs of the current frame. Needed before each filter(), for a plan that overlaps no frames uses their
  // memory again.
  void read() { source_.read(frame_, roles_, session_->inputs(0)); }
  void filter() { session_->filter(frame_, times_); }
  std::vector<quell_image> outputs() const { return session_->outputs(); }
  std::vector<quell_image> inputs() const { return session_->inputs(0); }
  // The current frame over and over, its reading not timed.
  Contestant contestant(std::string name) {
    return {std::move(name), [this] { filter(); }, [this] { read(); }};
  }
  // On to the next frame, its inputs read.
  void advance() {
    session_->advance();
    ++frame_;
    read();
  }

 private:
  Graph graph_;
  SyntheticSource source_;
  Workers workers_;
  std::vector<std::string> roles_;
  std::vector<double> times_;
  std::unique_ptr<Session> session_;
  std::int64_t frame_ = 0;
};

}  // namespace quell::bench
