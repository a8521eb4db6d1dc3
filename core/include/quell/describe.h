// How a node's struct becomes its table: `describe` runs once on a prototype to write ports, parameters and docs, and
// once on each configured instance to read its reaches.
#pragma once

#include <quell/tile.h>

#include <deque>
#include <initializer_list>
#include <limits>
#include <type_traits>
#include <vector>

namespace quell {

class Describe {
 public:
  class Port {
   public:
    Port(quell_port* port, quell_reach* reach) : port_(port), reach_(reach) {}
    Port& optional() {
      if (port_) port_->flags |= QUELL_OPTIONAL;
      return *this;
    }
    // Read up to `n` pixels away in each direction.
    Port& halo(int n) { return halo(n, n); }
    Port& halo(int x, int y) {
      reach_->left = reach_->right = x;
      reach_->up = reach_->down = y;
      return *this;
    }
    // Any pixel of the image may be read.
    Port& anywhere() {
      reach_->anywhere = 1;
      return *this;
    }
    // Rows s apart are read together, so the host gives tall tiles and the node visits their rows by residue.
    Port& step(int s) {
      reach_->step = s;
      return *this;
    }

   private:
    quell_port* port_;
    quell_reach* reach_;
  };

  class OutPort {
   public:
    explicit OutPort(quell_port* port) : port_(port) {}
    // The input that stands in for this output when the node is bypassed.
    template <class T>
    OutPort& passes(const In<T>& input) {
      if (port_) port_->passes = input.index;
      return *this;
    }
    // The output exists only when this input is connected.
    template <class T>
    OutPort& with(const In<T>& input) {
      if (port_) port_->with = input.index;
      return *this;
    }

   private:
    quell_port* port_;
  };

  class Param {
   public:
    explicit Param(quell_param* param) : param_(param) {}
    Param& range(double min, double max) {
      if (param_) param_->min = min, param_->max = max;
      return *this;
    }

   private:
    quell_param* param_;
  };

  Describe(void* instance, bool table) : base_(static_cast<const char*>(instance)), table_(table) {}

  // One sentence: what the node does.
  void summary(const char* text) { summary_ = text; }
  // Where the formula comes from: paper, equation.
  void source(const char* text) { source_ = text; }

  template <class T>
  Port in(In<T>& field, const char* name, const char* doc) {
    return input(field.index, name, doc, T::type, 0);
  }
  template <class T>
  Port in(InList<T>& field, const char* name, const char* doc) {
    return input(field.index, name, doc, T::type, QUELL_LIST);
  }
  template <class T>
  OutPort out(Out<T>& field, const char* name, const char* doc) {
    field.index = outputs_count_++;
    return OutPort(table_ ? &outputs_.emplace_back(quell_port{name, doc, T::type, 0, -1, -1}) : nullptr);
  }
  template <class T>
  requires(!std::is_enum_v<T>) Param param(T& field, const char* name, const char* doc) {
    if (!table_) return Param(nullptr);
    constexpr double inf = std::numeric_limits<double>::infinity();
    auto& p = params_.emplace_back(quell_param{name, doc, 0, 1, offset(&field), -inf, inf, nullptr, 0, 0});
    if constexpr (std::is_same_v<T, bool>) {
      p.kind = QUELL_BOOL, p.min = 0, p.max = 1;
    } else if constexpr (std::is_same_v<T, int>) {
      p.kind = QUELL_INT;
    } else if constexpr (std::is_same_v<T, float>) {
      p.kind = QUELL_FLOAT;
    } else if constexpr (std::is_same_v<T, Path>) {
      p.kind = QUELL_PATH;
    } else if constexpr (std::is_same_v<T, Text>) {
      p.kind = QUELL_TEXT;
    } else if constexpr (requires { field.v[0]; }) {
      p.kind = QUELL_FLOATS, p.count = int(sizeof(field.v) / sizeof(float));
    } else {
      static_assert(sizeof(T) == 0, "a parameter is bool, int, float, Text, Path, Vec<N> or an enum with names");
    }
    return Param(&p);
  }
  // An enum class of int32_t whose values count from 0, with a name each.
  template <class E>
  requires(std::is_enum_v<E> && sizeof(E) == 4) Param
      param(E& field, const char* name, const char* doc, std::initializer_list<const char*> names) {
    if (!table_) return Param(nullptr);
    auto& kept = choices_.emplace_back(names);
    return Param(&params_.emplace_back(quell_param{name, doc, QUELL_CHOICE, 1, offset(&field), 0,
                                                   double(kept.size()) - 1, kept.data(), int(kept.size()), 0}));
  }

  // What was described; read by NodeTable.
  const char* summary() const { return summary_; }
  const char* source() const { return source_; }
  std::vector<quell_port> inputs() const { return {inputs_.begin(), inputs_.end()}; }
  std::vector<quell_port> outputs() const { return {outputs_.begin(), outputs_.end()}; }
  std::vector<quell_param> params() const { return {params_.begin(), params_.end()}; }
  const std::deque<quell_reach>& reaches() const { return reaches_; }

 private:
  Port input(std::int32_t& index, const char* name, const char* doc, int type, std::uint32_t flags) {
    index = inputs_count_++;
    auto* reach = &reaches_.emplace_back();
    return Port(table_ ? &inputs_.emplace_back(quell_port{name, doc, type, flags, -1, -1}) : nullptr, reach);
  }
  std::size_t offset(const void* field) const { return std::size_t(static_cast<const char*>(field) - base_); }

  const char* base_;
  bool table_;
  const char* summary_ = "";
  const char* source_ = "";
  int inputs_count_ = 0, outputs_count_ = 0;
  std::deque<quell_port> inputs_, outputs_;  // deques, for Port and OutPort point into them
  std::deque<quell_param> params_;
  std::deque<quell_reach> reaches_;
  std::deque<std::vector<const char*>> choices_;
};

}  // namespace quell
