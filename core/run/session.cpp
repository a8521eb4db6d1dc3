// One plan at work.
#include "core/run/session.h"

#include "core/run/memory_limit.h"

#include <chrono>
#include <utility>

namespace quell {

namespace {

// One thread does one thing at a time.
Overlap overlap_on(const Workers& workers) { return {workers.threads() > 1, workers.threads() > 1}; }

}  // namespace

Session::Session(const Graph& graph, std::vector<quell_shape> inputs, Workers& workers, const RunOptions& options)
    : graph_(&graph),
      input_shapes_(std::move(inputs)),
      plan_(plan_within(graph, input_shapes_, overlap_on(workers), options.max_memory)),
      buffers_(plan_),
      resources_(graph, plan_),
      workers_(&workers),
      wanted_rows_(options.band_rows),
      trace_(options.trace),
      taps_(options.taps),
      bound_(graph.nodes.size()) {
  buffers_.forget(ordinal_);
}

std::vector<quell_image> Session::inputs(int ahead) const {
  std::vector<quell_image> images;
  for (std::size_t i = 0; i < graph_->inputs.size(); ++i) images.push_back(buffers_.image(i, ordinal_, -ahead));
  return images;
}

std::vector<quell_image> Session::outputs() const {
  std::vector<quell_image> images;
  for (const auto& output : graph_->outputs) images.push_back(wire_image(output.wire));
  return images;
}

quell_image Session::wire_image(const Wire& wire) const {
  const bool missing = wire.delay > age_;
  if (missing && wire.start.node != Source::kNone) return buffers_.image(plan_.value_of(wire.start), ordinal_, 0);
  quell_image image = buffers_.image(plan_.value_of(wire.from), ordinal_, wire.delay);
  image.missing = missing ? 1 : 0;
  return image;
}

void Session::bind(std::size_t n) {
  const auto& node = graph_->nodes[n];
  auto& b = bound_[n];
  b = {};
  const std::size_t ports = node.in.size();
  b.images.resize(ports);
  b.weights.resize(ports);
  bool listen = taps_ && taps_->on;
  for (std::size_t p = 0; p < ports; ++p) {
    const bool weight = node.type().inputs()[p].type == QUELL_WEIGHT;
    for (const auto& wire : node.in[p]) {
      if (!weight) {
        b.images[p].push_back(wire_image(wire));
        continue;
      }
      const auto from = std::size_t(wire.from.node);
      const auto& source = graph_->nodes[from];
      const quell_bound_weight bound{source.type().table().weigh, source.instance.data(), resources_.of(from),
                                     bound_[from].in.data()};
      b.weights[p].push_back(std::exchange(listen, false) ? taps_->listen(n, bound) : bound);
    }
    b.in.push_back(
        {weight ? nullptr : b.images[p].data(), weight ? b.weights[p].data() : nullptr, int(node.in[p].size())});
  }
  for (std::size_t o = 0; o < node.type().outputs().size(); ++o)
    b.out.push_back(buffers_.image(plan_.value_of({int(n), int(o)}), ordinal_, 0));
}

void Session::filter(std::int64_t frame, std::span<double> times) {
  for (std::size_t n = 0; n < graph_->nodes.size(); ++n) {
    const auto& node = graph_->nodes[n];
    bind(n);
    if (node.type().is_weight()) continue;
    const Trace::Span span(trace_, {node.name, node.type().name(), frame}, Trace::kGraph);
    const auto begin = std::chrono::steady_clock::now();
    const auto& planned = plan_.nodes()[n];
    const quell_tile tile{bound_[n].in.data(), bound_[n].out.data(), 0, 0, 0, 0, frame};
    workers_->run(node, resources_.of(n), tile, planned.tiled, plan_.band_rows(n, workers_->threads(), wanted_rows_));
    times[n] = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
}

void Session::advance() { ++ordinal_, ++age_; }

void Session::forget() {
  age_ = 0;
  buffers_.forget(ordinal_);
}

}  // namespace quell
