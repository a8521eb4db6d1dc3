// Chains of nodes.
#include "core/run/chains.h"

#include "core/run/plan.h"

#include <quell/types.h>

namespace quell {

namespace {

bool at_own_rows(const quell_reach& r) { return !r.up && !r.down && !r.anywhere; }

class Chains {
 public:
  explicit Chains(const Plan& plan) : plan_(plan), graph_(plan.graph()) {}

  std::vector<Chain> find() {
    for (std::size_t n = 0; n < graph_.nodes.size(); ++n) {
      if (found_.empty() || (!is_weight(n) && found_.back().runs && !joins(n, found_.back().first)))
        found_.push_back({n, n, 0, 0});
      found_.back().end = n + 1;
      found_.back().runs += !is_weight(n);
    }
    part_what_is_not_read();
    return std::move(found_);
  }

 private:
  bool is_weight(std::size_t n) const { return graph_.nodes[n].type().is_weight(); }

  // Calls f(source, at own rows) for each value of the current frame that a node and its weight nodes read.
  template <class F>
  void each_read(std::size_t n, F&& f) const {
    const auto read = [&](const Wire& wire, bool own_rows) {
      if (wire.delay == 0) f(wire.from, own_rows);
      if (wire.start.node != Source::kNone) f(wire.start, own_rows);
    };
    const auto& nodes = plan_.nodes();
    for (std::size_t p = 0; p < graph_.nodes[n].in.size(); ++p)
      for (const auto& wire : graph_.nodes[n].in[p]) {
        const bool own_rows = at_own_rows(nodes[n].reach[p]);
        if (wire.from.node < 0 || !is_weight(std::size_t(wire.from.node))) {
          read(wire, own_rows);
          continue;
        }
        const auto weight = std::size_t(wire.from.node);
        for (std::size_t q = 0; q < graph_.nodes[weight].in.size(); ++q)
          for (const auto& inner : graph_.nodes[weight].in[q])
            read(inner, own_rows && at_own_rows(nodes[weight].reach[q]));
      }
  }

  const quell_shape& size_of(std::size_t n) const {
    return plan_.values()[plan_.value_of({int(n), plan_.nodes()[n].tiled})].shape;
  }
  // Rows by residue want bands of their own height.
  bool can_chain(std::size_t n) const {
    if (plan_.nodes()[n].step > 1) return false;
    for (std::size_t o = 0; o < graph_.nodes[n].type().outputs().size(); ++o) {
      const auto& v = plan_.values()[plan_.value_of({int(n), int(o)})];
      if (!v.exists) continue;
      if (type_info(v.type)->storage != Storage::pixels) return false;
      if (v.shape.width != size_of(n).width || v.shape.height != size_of(n).height) return false;
    }
    return true;
  }

  bool joins(std::size_t n, std::size_t first) const {
    std::size_t head = first;
    while (is_weight(head)) ++head;
    if (!can_chain(n) || !can_chain(head)) return false;
    if (size_of(n).width != size_of(head).width || size_of(n).height != size_of(head).height) return false;
    bool reads = false, fits = true;
    each_read(n, [&](const Source& from, bool own_rows) {
      if (from.node < int(first)) return;
      reads = true;
      fits &= own_rows;
    });
    const auto& planned = plan_.nodes()[n];
    return fits && (reads || (planned.max_row_reach == 0 && !planned.anywhere));
  }

  // Whom no other reads would gain nothing, and may have a wide halo, for which short bands are dear.
  void part_what_is_not_read() {
    std::vector<Chain> parted;
    for (auto chain : found_) {
      while (chain.runs > 1 && !is_read_within(chain)) {
        const std::size_t first = chain.first;
        while (is_weight(chain.first++)) {
        }
        parted.push_back({first, chain.first, 1, 0});
        --chain.runs;
      }
      parted.push_back(chain);
    }
    found_ = std::move(parted);
  }
  bool is_read_within(const Chain& chain) const {
    std::size_t head = chain.first;
    while (is_weight(head)) ++head;
    bool read = false;
    for (std::size_t n = head + 1; n < chain.end; ++n)
      if (!is_weight(n)) each_read(n, [&](const Source& from, bool) { read |= from.node == int(head); });
    return read;
  }

  const Plan& plan_;
  const Graph& graph_;
  std::vector<Chain> found_;
};

}  // namespace

std::vector<Chain> chains_of(const Plan& plan) { return Chains(plan).find(); }

}  // namespace quell
