// Shapes, lifetimes and memory of a graph's values.
#include "core/run/plan.h"

#include "core/image/image.h"
#include "core/report/error.h"
#include "core/run/intervals.h"
#include "core/run/reads.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>

namespace quell {

namespace {

std::string shown(const quell_shape& s) { return fmt::format("{}x{}", s.width, s.height); }

bool same_shape(const quell_shape& a, const quell_shape& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels;
}

bool is_pixels(int type) {
  const auto* info = type_info(type);
  return info && info->storage == Storage::pixels;
}

// That the images of a node go together: a kernel takes one size, one pitch and the channels of a type for granted.
class Fit {
 public:
  explicit Fit(const GraphNode& node) : node_(node) {}

  void image(const quell_port& port, const quell_shape& s) {
    const auto* info = type_info(port.type);
    if (info && info->channels && s.channels != info->channels)
      fail("input '{}' is {} of {} channels, but what it reads has {}", port.name, info->name, info->channels,
           s.channels);
    if (port.type == QUELL_ANY && node_.type().shares_type(port)) {
      if (any_.empty()) any_ = port.name, channels_ = s.channels;
      if (s.channels != channels_)
        fail("input '{}' has {} channels, but '{}' has {}", port.name, s.channels, any_, channels_);
    }
    if (port.type != QUELL_FEATURES) size(port, s);
  }
  // Weights are read at the pixels of the image that they filter.
  void size(const quell_port& port, const quell_shape& s) {
    if (first_.empty()) first_ = port.name, size_ = s;
    if (s.width != size_.width || s.height != size_.height)
      fail("input '{}' is {}, but '{}' is {}: the images of a node have one size", port.name, shown(s), first_,
           shown(size_));
  }
  void start(const quell_port& port, const quell_shape& start, const quell_shape& s) {
    if (!same_shape(start, s))
      fail("the start of input '{}' is {} with {} channels, but what it stands in for is {} with {}", port.name,
           shown(start), start.channels, shown(s), s.channels);
  }
  void output(const quell_port& port, int type, const quell_shape& s) {
    const auto* info = type_info(type);
    if (info && info->channels && s.channels != info->channels)
      fail("output '{}' is {} of {} channels, but would have {}", port.name, info->name, info->channels, s.channels);
    if (info && info->channels && port.type == QUELL_ANY && !any_.empty() && channels_ != info->channels)
      fail("input '{}' is {} of {} channels, but what it reads has {}", any_, info->name, info->channels, channels_);
  }

 private:
  template <class... A>
  [[noreturn]] void fail(fmt::format_string<A...> format, A&&... args) const {
    throw Error(Exit::usage, node_.name + ": " + fmt::format(format, std::forward<A>(args)...));
  }
  const GraphNode& node_;
  std::string first_, any_;
  quell_shape size_{};
  int channels_ = 0;
};

quell_spec spec_of(const PlannedNode& n) { return {n.in.data(), n.in_count.data(), n.in_channels.data()}; }

}  // namespace

std::string place_of(const PlannedValue& v) {
  if (v.local) return "a band";
  return v.slots ? fmt::format("ring of {}", v.slots) : fmt::format("steps {}-{}", v.first, v.last);
}

Plan::Plan(const Graph& graph, std::span<const quell_shape> inputs, Overlap overlap)
    : graph_(&graph), overlap_(overlap) {
  list_values(inputs);
  // A delayed wire may come from a node later in the order, whose shape a first pass does not know: passes are made
  // until nothing changes. A chain of more loops than this, each sized by the next alone, is no pipeline.
  constexpr int kMostPasses = 64;
  for (int pass = 0; pass < kMostPasses && shapes(false); ++pass) {
  }
  shapes(true);
  for (const auto& output : graph.outputs) {
    const auto* info = type_info(output.type);
    const auto& value = values_[value_of(output.wire.from)];
    if (info && info->channels && value.shape.channels != info->channels)
      throw Error(Exit::usage, fmt::format("output '{}' is {} of {} channels, but '{}' has {}", output.name, info->name,
                                           info->channels, value.name, value.shape.channels));
    if (output.wire.start.node != Source::kNone && !same_shape(value.shape, values_[value_of(output.wire.start)].shape))
      throw Error(Exit::usage,
                  fmt::format("output '{}': '{}' and its start have unlike sizes", output.name, value.name));
  }
  chains_ = chains_of(*this);
  for (std::size_t c = 0; c < chains_.size(); ++c)
    for (std::size_t n = chains_[c].first; n < chains_[c].end; ++n) chain_of_.push_back(c);
  chain_of_.push_back(chains_.size());  // after the last node
  lifetimes();
  memory();
}

void Plan::list_values(std::span<const quell_shape> inputs) {
  const auto& g = *graph_;
  for (std::size_t i = 0; i < g.inputs.size(); ++i) {
    PlannedValue v;
    v.name = g.inputs[i].name, v.type = g.inputs[i].type, v.shape = inputs[i], v.exists = true;
    values_.push_back(std::move(v));
  }
  for (const auto& node : g.nodes) {
    first_value_.push_back(values_.size());
    for (std::size_t o = 0; o < node.type().outputs().size(); ++o) {
      PlannedValue v;
      v.name = node.name + "." + node.type().outputs()[o].name;
      v.type = node.out_types[o];
      values_.push_back(std::move(v));
    }
  }
}

bool Plan::shapes(bool settled) {
  const auto& g = *graph_;
  bool changed = false;
  nodes_.assign(g.nodes.size(), {});
  for (std::size_t n = 0; n < g.nodes.size(); ++n) {
    const auto& node = g.nodes[n];
    const auto ports = node.type().inputs();
    auto& planned = nodes_[n];
    planned.in.resize(ports.size());
    planned.in_count.resize(ports.size());
    planned.in_channels.resize(ports.size());
    planned.reach = node.instance.reach();
    quell_shape first{};
    Fit fit(node);
    bool images = false;
    int any_channels = 0, feature_channels = 0;
    for (const bool delayed : {false, true})
      for (std::size_t p = 0; p < ports.size(); ++p) {
        if (ports[p].type == QUELL_WEIGHT) {
          planned.in_count[p] = int(node.in[p].size());
          for (const auto& wire : node.in[p])
            if (const auto& weighed = values_[value_of(wire.from)].shape; settled && delayed && weighed.width)
              fit.size(ports[p], weighed);
          continue;
        }
        for (const auto& wire : node.in[p]) {
          if ((wire.delay > 0) != delayed) continue;
          const auto& value = values_[value_of(wire.from)];
          quell_shape s = value.shape;
          if (s.width == 0 && wire.start.node != Source::kNone) s = values_[value_of(wire.start)].shape;
          if (s.width == 0 && delayed) s = {first.width, first.height, 0};
          if (const auto* info = type_info(value.type); info && info->channels && s.channels == 0)
            s.channels = info->channels;
          if (planned.in_count[p]++ == 0) planned.in[p] = s;
          constexpr int kMostChannels = 1 << 16;
          if (s.channels > kMostChannels - planned.in_channels[p])
            throw Error(Exit::usage, fmt::format("{}: input '{}' would have more than {} channels", node.name,
                                                 ports[p].name, kMostChannels));
          planned.in_channels[p] += s.channels;
          if (!is_pixels(value.type)) continue;
          images = true;
          if (s.width == 0) continue;  // not known yet
          if (first.width == 0) first = s;
          if (settled) fit.image(ports[p], s);
          if (settled && wire.start.node != Source::kNone) fit.start(ports[p], values_[value_of(wire.start)].shape, s);
          if (ports[p].type == QUELL_ANY && any_channels == 0) any_channels = s.channels;
          if (ports[p].type == QUELL_FEATURES && feature_channels == 0) feature_channels = s.channels;
        }
      }
    if (images && first.width == 0) {
      if (settled)
        throw Error(Exit::usage, fmt::format("{}: its size is not known, for it reads nothing but the past; give a "
                                             "delayed wire a \"start\"",
                                             node.name));
      continue;
    }
    std::vector<quell_shape> out;
    for (std::size_t o = 0; o < node.type().outputs().size(); ++o) {
      const auto& port = node.type().outputs()[o];
      const auto* info = type_info(node.out_types[o]);
      quell_shape s = first;
      s.channels = info && info->channels ? info->channels : port.type == QUELL_ANY ? any_channels : feature_channels;
      if (info && info->storage == Storage::value) s = {1, 1, 1};
      out.push_back(s);
    }
    const auto& table = node.type().table();
    if (table.shapes) {
      const auto spec = spec_of(planned);
      quell_error error{};
      // Before shapes are settled it may see a guess that it is right to refuse.
      if (table.shapes(node.instance.data(), &spec, out.data(), &error) && settled)
        throw Error(Exit::plugin, fmt::format("{} ({}): {}", node.name, table.name, error.text));
    }
    int first_output = -1;
    planned.tiled = -1;
    for (std::size_t o = 0; o < out.size(); ++o) {
      auto& value = values_[first_value_[n] + o];
      const int with = node.type().outputs()[o].with;
      if (!same_shape(value.shape, out[o])) {
        if (settled)
          throw Error(Exit::usage, fmt::format("{}: output '{}' would grow from {} with {} channels to {} with {}: a "
                                               "size cannot depend on its own past",
                                               node.name, node.type().outputs()[o].name, shown(value.shape),
                                               value.shape.channels, shown(out[o]), out[o].channels));
        changed = true;
      }
      value.shape = out[o];
      value.exists = !node.type().is_weight() && (with < 0 || !node.in[std::size_t(with)].empty());
      if (!value.exists) continue;
      if (first_output < 0) first_output = int(o);
      if (planned.tiled < 0 && is_pixels(value.type)) planned.tiled = int(o);
      if (!settled) continue;
      if (out[o].width <= 0 || out[o].height <= 0 || out[o].channels <= 0)
        throw Error(Exit::plugin,
                    fmt::format("{} ({}): output '{}' would be {}x{} with {} channels", node.name, table.name,
                                node.type().outputs()[o].name, out[o].width, out[o].height, out[o].channels));
      fit.output(node.type().outputs()[o], value.type, out[o]);
    }
    if (planned.tiled < 0) planned.tiled = std::max(first_output, 0);
    for (const auto& r : planned.reach) {
      planned.step = std::max(planned.step, r.step);
      planned.anywhere |= r.anywhere != 0;
      planned.max_row_reach = std::max({planned.max_row_reach, r.up, r.down});
    }
  }
  return changed;
}

void Plan::lifetimes() {
  const auto& g = *graph_;
  const int end = int(g.nodes.size());
  const auto read = [&](const Wire& wire, int step) {
    auto& from = values_[value_of(wire.from)];
    from.delay = std::max(from.delay, wire.delay);
    if (wire.delay == 0) from.last = std::max(from.last, step);
    if (wire.start.node != Source::kNone) {
      auto& start = values_[value_of(wire.start)];
      start.last = std::max(start.last, step);
    }
  };
  for (std::size_t n = 0; n < g.nodes.size(); ++n)
    for (std::size_t o = 0; o < g.nodes[n].type().outputs().size(); ++o) {
      auto& v = values_[first_value_[n] + o];
      v.first = v.last = int(n);
    }
  for (std::size_t n = 0; n < g.nodes.size(); ++n)
    if (!g.nodes[n].type().is_weight()) for_each_read(g, n, [&](const Wire& wire) { read(wire, int(n)); });
  for (const auto& output : g.outputs) {
    read(output.wire, end);
    values_[value_of(output.wire.from)].output = true;
    if (output.wire.start.node != Source::kNone) values_[value_of(output.wire.start)].output = true;
  }
}

void Plan::memory() {
  std::vector<Interval> intervals;
  std::vector<PlannedValue*> in_arena;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    auto& v = values_[i];
    if (!v.exists) continue;
    v.floats = plane_floats(v.shape.width, v.shape.height) * std::size_t(v.shape.channels);
    // One slot more for an input, so that the next frame is read while this one is filtered, and one more for an
    // output, so that it is written while the next is filtered.
    const bool ahead = overlap_.reading && i < graph_->inputs.size(), behind = overlap_.writing && v.output;
    if (ahead || behind || v.delay > 0) {
      v.slots = v.delay + 1 + int(ahead) + int(behind);
      ring_floats_ += v.floats * std::size_t(v.slots);
      continue;
    }
    // Bands of all nodes of a chain are under way at once, so a value lives as long as the chains that it touches.
    const bool made = i >= graph_->inputs.size(), read = std::size_t(v.last) < graph_->nodes.size();
    const std::size_t from = chain_of_[std::size_t(v.first)], to = chain_of_[std::size_t(v.last)];
    v.local = made && read && from == to && chains_[from].runs > 1;
    if (v.local) continue;
    intervals.push_back(
        {made ? int(chains_[from].first) : v.first, read ? int(chains_[to].end) - 1 : v.last, v.floats});
    in_arena.push_back(&v);
  }
  arena_floats_ = place(intervals);
  for (std::size_t i = 0; i < intervals.size(); ++i) in_arena[i]->offset = intervals[i].offset;
  place_bands();
}

void Plan::place_bands() {
  for (auto& chain : chains_) {
    std::vector<Interval> intervals;
    std::vector<PlannedValue*> local;
    const std::size_t end = chain.end < first_value_.size() ? first_value_[chain.end] : values_.size();
    for (std::size_t i = first_value_[chain.first]; i < end; ++i) {
      auto& v = values_[i];
      if (!v.exists || !v.local) continue;
      intervals.push_back({v.first, v.last, std::size_t(v.shape.channels)});
      local.push_back(&v);
    }
    chain.planes = place(intervals);
    for (std::size_t i = 0; i < intervals.size(); ++i) local[i]->offset = intervals[i].offset;
  }
}

std::size_t Plan::bytes_of(std::size_t node) const {
  std::size_t floats = 0;
  for (std::size_t o = 0; o < graph_->nodes[node].type().outputs().size(); ++o)
    if (const auto& v = values_[first_value_[node] + o]; v.exists)
      floats += v.floats * std::size_t(std::max(v.slots, 1));
  return floats * sizeof(float);
}

std::size_t Plan::bytes_without_reuse() const {
  std::size_t floats = ring_floats_;
  for (const auto& v : values_)
    if (v.slots == 0) floats += v.floats;
  return floats * sizeof(float);
}

int Plan::band_rows(const Chain& chain, int threads, int wanted) const {
  std::size_t node = chain.first;
  while (graph_->nodes[node].type().is_weight()) ++node;
  const auto& planned = nodes_[node];
  const int height = values_[first_value_[node] + std::size_t(planned.tiled)].shape.height;
  if (wanted > 0) return std::min(wanted, height);
  // Rows by residue need tall bands (8 steps); else bands are small enough to balance and tall enough to reuse their
  // halo.
  int least = std::max(32, 8 * planned.step);
  if (chain.runs > 1) {
    // What the chain makes of a band is to stay in a core's second-level cache; measured, 4 to 16 rows are alike.
    constexpr std::size_t kBand = std::size_t(1) << 20;
    std::size_t row_floats = 0;
    for (std::size_t n = chain.first; n < chain.end; ++n)
      for (std::size_t o = 0; o < graph_->nodes[n].type().outputs().size(); ++o)
        if (const auto& v = values_[first_value_[n] + o]; v.exists)
          row_floats += std::size_t(v.shape.width) * std::size_t(v.shape.channels);
    least = std::clamp(int(kBand / (row_floats * sizeof(float))), 4, least);
  }
  int bands = std::max(1, height / least);
  if (bands > threads) bands = bands / threads * threads;  // as many for each thread, never smaller than that
  return (height + bands - 1) / bands;
}

std::string Plan::describe() const {
  const auto& g = *graph_;
  constexpr double kMiB = 1024.0 * 1024.0;
  std::string out = fmt::format("{} nodes in order, and the MiB of the images that they write\n", g.nodes.size());
  for (std::size_t n = 0; n < g.nodes.size(); ++n) {
    const auto& p = nodes_[n];
    const bool weight = g.nodes[n].type().is_weight();
    std::string reach = p.anywhere ? "anywhere" : p.max_row_reach ? fmt::format("halo {}", p.max_row_reach) : "pixel";
    if (p.step > 1) reach += fmt::format(", step {}", p.step);
    out += fmt::format("{:4}  {:28} {:20} {:22} {:>9}", n, g.nodes[n].name, g.nodes[n].type().name(), reach,
                       weight ? "-" : fmt::format("{:.1f}", double(bytes_of(n)) / kMiB));
    for (std::size_t o = 0; !weight && o < g.nodes[n].type().outputs().size(); ++o) {
      const auto& v = values_[first_value_[n] + o];
      if (!v.exists) continue;
      out += fmt::format(" {}:{} {}x{}x{} ({})", g.nodes[n].type().outputs()[o].name, type_name(v.type), v.shape.width,
                         v.shape.height, v.shape.channels, place_of(v));
    }
    out += '\n';
  }
  out += "inputs\n";
  for (std::size_t i = 0; i < g.inputs.size(); ++i) {
    const auto& v = values_[i];
    out += fmt::format("      {:28} {:20} {:22} {:>9.1f} {}x{}x{} ({})\n", v.name, type_name(v.type), "",
                       double(v.bytes()) / kMiB, v.shape.width, v.shape.height, v.shape.channels, place_of(v));
  }
  out += fmt::format(
      "memory: {:.1f} MiB: {:.1f} arena, {:.1f} rings of inputs, outputs and history ({:.1f} without reuse)\n",
      double(bytes()) / kMiB, double(arena_floats_ * sizeof(float)) / kMiB, double(ring_floats_ * sizeof(float)) / kMiB,
      double(bytes_without_reuse()) / kMiB);
  return out;
}

Resources::Resources(const Graph& graph, const Plan& plan) {
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    const auto& table = graph.nodes[n].type().table();
    void* resource = nullptr;
    if (table.prepare) {
      const auto spec = spec_of(plan.nodes()[n]);
      quell_error error{};
      if (table.prepare(graph.nodes[n].instance.data(), &spec, &resource, &error))
        throw Error(Exit::plugin, fmt::format("{} ({}): {}", graph.nodes[n].name, table.name, error.text));
    }
    resources_.emplace_back(
        resource, table.release ? table.release : [](void*) {});
  }
}

}  // namespace quell
