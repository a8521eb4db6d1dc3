// One plan at work.
#include "core/run/session.h"

#include "core/run/memory_limit.h"

#include <algorithm>
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
      bands_(std::size_t(workers.threads())) {
  for (auto& band : bands_) band.prepare(plan_);
  buffers_.forget(ordinal_);
}

std::vector<quell_image> Session::inputs(int ahead) const {
  std::vector<quell_image> images;
  for (std::size_t i = 0; i < graph_->inputs.size(); ++i) images.push_back(buffers_.image(i, ordinal_, -ahead));
  return images;
}

std::vector<quell_image> Session::outputs() const {
  std::vector<quell_image> images;
  for (const auto& output : graph_->outputs) images.push_back(wire_image(output.wire, bands_[0]));
  return images;
}

quell_image Session::value_image(std::size_t value, int delay, const Band& band) const {
  const auto& v = plan_.values()[value];
  return v.exists && v.local ? band.image(value) : buffers_.image(value, ordinal_, delay);
}

quell_image Session::wire_image(const Wire& wire, const Band& band) const {
  const bool missing = wire.delay > age_;
  if (missing && wire.start.node != Source::kNone) return value_image(plan_.value_of(wire.start), 0, band);
  quell_image image = value_image(plan_.value_of(wire.from), wire.delay, band);
  image.missing = missing ? 1 : 0;
  return image;
}

void Session::bind(const Chain& chain, std::size_t n, Band& band) {
  const auto& node = graph_->nodes[n];
  auto& b = band.bound[n];
  b = {};
  const std::size_t ports = node.in.size();
  b.images.resize(ports);
  b.weights.resize(ports);
  bool listen = taps_ && taps_->on;
  for (std::size_t p = 0; p < ports; ++p) {
    const bool weight = node.type().inputs()[p].type == QUELL_WEIGHT;
    for (const auto& wire : node.in[p]) {
      if (!weight) {
        b.images[p].push_back(wire_image(wire, band));
        continue;
      }
      const auto from = std::size_t(wire.from.node);
      const auto& source = graph_->nodes[from];
      const auto& in = (from < chain.first ? bands_[0] : band).bound[from].in;
      const quell_bound_weight bound{source.type().table().weigh, source.instance.data(), resources_.of(from),
                                     in.data()};
      b.weights[p].push_back(std::exchange(listen, false) ? taps_->listen(n, bound) : bound);
    }
    b.in.push_back(
        {weight ? nullptr : b.images[p].data(), weight ? b.weights[p].data() : nullptr, int(node.in[p].size())});
  }
  for (std::size_t o = 0; o < node.type().outputs().size(); ++o)
    b.out.push_back(value_image(plan_.value_of({int(n), int(o)}), 0, band));
}

void Session::run_rows(const Chain& chain, const Band& band, std::vector<double>& seconds, const quell_tile& rows) {
  for (std::size_t n = chain.first; n < chain.end; ++n) {
    const auto& node = graph_->nodes[n];
    if (node.type().is_weight()) continue;
    const auto begin = std::chrono::steady_clock::now();
    quell_tile tile = rows;
    tile.in = band.bound[n].in.data(), tile.out = band.bound[n].out.data();
    tile.x1 = tile.out[plan_.nodes()[n].tiled].width;
    workers_->run(node, resources_.of(n), tile);
    seconds[n] += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
}

void Session::share_out(const Chain& chain, double wall, std::span<double> times) const {
  double sum = 0;
  for (std::size_t n = chain.first; n < chain.end; ++n)
    for (const auto& band : bands_) sum += band.seconds[n];
  for (std::size_t n = chain.first; n < chain.end; ++n)
    for (const auto& band : bands_)
      if (band.seconds[n] > 0) times[n] += wall * band.seconds[n] / sum;
}

void Session::filter(std::int64_t frame, std::span<double> times) {
  std::ranges::fill(times, 0.0);
  for (const auto& chain : plan_.chains()) {
    // What holds no value of a band's is bound once for all threads.
    for (std::size_t t = 0; t < bands_.size(); ++t)
      for (std::size_t n = chain.first; n < chain.end; ++n) {
        if (t == 0 || chain.planes) bind(chain, n, bands_[t]);
        bands_[t].seconds[n] = 0;
      }
    if (!chain.runs) continue;
    std::size_t head = chain.first;
    while (graph_->nodes[head].type().is_weight()) ++head;
    const auto& node = graph_->nodes[head];
    const Trace::Span span(trace_, {node.name, chain.runs > 1 ? "chain" : node.type().name(), frame}, Trace::kGraph);
    const auto begin = std::chrono::steady_clock::now();
    const int height = bands_[0].bound[head].out[std::size_t(plan_.nodes()[head].tiled)].height;
    const int rows = plan_.band_rows(chain, workers_->threads(), wanted_rows_);
    workers_->run(height, rows, [&](int thread, int y0, int y1) {
      auto& own = bands_[std::size_t(thread)];
      if (chain.planes) own.aim(chain, y0, rows);
      run_rows(chain, chain.planes ? own : bands_[0], own.seconds, {nullptr, nullptr, 0, y0, 0, y1, frame});
    });
    share_out(chain, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), times);
  }
}

double Session::busy(std::size_t node) const {
  double sum = 0;
  for (const auto& band : bands_) sum += band.seconds[node];
  return sum;
}

void Session::advance() { ++ordinal_, ++age_; }

void Session::forget() {
  age_ = 0;
  buffers_.forget(ordinal_);
}

}  // namespace quell
