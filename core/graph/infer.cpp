// A type variable takes the type of the first undelayed wire into a port of type any; where all are delayed, of the
// first whose type comes to be known.
#include "core/graph/check.h"

#include <quell/types.h>

#include <deque>

namespace quell {

namespace {

class Inference {
 public:
  explicit Inference(Net& net) : net_(net), readers_(net.nodes.size()) {}

  void run() {
    for (std::size_t i = 0; i < net_.nodes.size(); ++i) {
      auto& n = net_.nodes[i];
      n.out_types.clear();
      for (const auto& o : n.type->outputs()) n.out_types.push_back(o.type == QUELL_ANY ? 0 : o.type);
      bool any = false;
      for (std::size_t p = 0; p < n.in.size(); ++p) {
        if (n.type->inputs()[p].type != QUELL_ANY) continue;
        any = true;
        for (const auto& l : n.in[p].links)
          for (const auto& t : {l.from, l.start})
            if (t.kind == Target::Kind::node) readers_[std::size_t(t.index)].push_back(int(i));
      }
      if (any) queue_.push_back(int(i));
    }
    const auto all = queue_;
    settle(false);
    queue_ = all;
    settle(true);
  }

 private:
  void settle(bool delayed) {
    while (!queue_.empty()) {
      const int i = queue_.front();
      queue_.pop_front();
      auto& n = net_.nodes[std::size_t(i)];
      if (bound(n)) continue;
      const int type = first(n, delayed);
      if (type == 0) continue;
      for (std::size_t o = 0; o < n.out_types.size(); ++o)
        if (n.type->outputs()[o].type == QUELL_ANY) n.out_types[o] = type;
      for (const int reader : readers_[std::size_t(i)]) queue_.push_back(reader);
    }
  }
  static bool bound(const NetNode& n) {
    for (std::size_t o = 0; o < n.out_types.size(); ++o)
      if (n.type->outputs()[o].type == QUELL_ANY) return n.out_types[o] != 0;
    return true;  // no output asks
  }
  int first(const NetNode& n, bool delayed) const {
    for (std::size_t p = 0; p < n.in.size(); ++p) {
      if (n.type->inputs()[p].type != QUELL_ANY) continue;
      for (const auto& l : n.in[p].links) {
        const bool started = l.start.kind != Target::Kind::none && !l.as;
        const int type = net_.type_of(l);
        if (!delayed && l.delay == 0) return type;
        if (!delayed && started) return net_.type_of(l.start);
        if (delayed && type != 0) return type;
      }
    }
    return 0;
  }

  Net& net_;
  std::vector<std::vector<int>> readers_;  // nodes with ports of type any
  std::deque<int> queue_;
};

}  // namespace

void infer_types(Net& net) { Inference(net).run(); }

}  // namespace quell
