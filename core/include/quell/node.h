// Everything that the author of a node includes. A node is a trivially copyable struct of ports and parameters with
//   void describe(quell::Describe&)                        ports, parameters, docs, reach
//   void run(const quell::Tile&[, const R&]) const         fills the tile of every output            (a filter)
//   void weigh(const quell_input*, const quell_run&, float* exponent[, const R&]) const             (a weight node)
//   R prepare(const quell_spec&) const                     optional: an immutable resource for run or weigh
//   void shapes(const quell_spec&, quell_shape*) const     optional: sizes of the outputs; required without image
//   inputs
// and one line QUELL_PLUGIN("name", Struct). Defaults are the member initialisers. Exceptions become the node's error.
#pragma once

#include <quell/abi.h>
#include <quell/describe.h>
#include <quell/tile.h>
#include <quell/types.h>

#include <cstdio>
#include <exception>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace quell {

template <class T>
concept Prepares = requires(const T& node, const quell_spec& spec) {
  node.prepare(spec);
};
template <class T>
concept Shapes = requires(const T& node, const quell_spec& spec, quell_shape* out) {
  node.shapes(spec, out);
};
template <class T>
concept Weighs = requires {
  &T::weigh;
};

template <class F>
std::int32_t guarded(quell_error* error, F&& call) noexcept {
  const char* text = "unknown exception";
  try {
    call();
    return 0;
  } catch (const std::exception& e) {
    std::snprintf(error->text, sizeof error->text, "%s", e.what());
    return 1;
  } catch (...) {
    std::snprintf(error->text, sizeof error->text, "%s", text);
    return 1;
  }
}

template <class T>
class NodeTable {
  static_assert(std::is_trivially_copyable_v<T>,
                "a node holds ports and parameters only: no std::string, no std::vector");

 public:
  explicit NodeTable(const char* name) : described_(&prototype_, true) {
    prototype_.describe(described_);
    inputs_ = described_.inputs();
    outputs_ = described_.outputs();
    params_ = described_.params();
    node_.size = sizeof node_;
    node_.name = name;
    node_.summary = described_.summary();
    node_.source = described_.source();
    node_.in = inputs_.data(), node_.in_count = int(inputs_.size());
    node_.out = outputs_.data(), node_.out_count = int(outputs_.size());
    node_.param = params_.data(), node_.param_count = int(params_.size());
    node_.instance_size = sizeof(T), node_.instance_align = alignof(T), node_.defaults = &prototype_;
    node_.reach = &reach;
    if constexpr (Shapes<T>) node_.shapes = &shapes;
    if constexpr (Prepares<T>) node_.prepare = &prepare, node_.release = &release;
    if constexpr (Weighs<T>)
      node_.weigh = &weigh;
    else
      node_.run = &run;
  }
  NodeTable(const NodeTable&) = delete;
  NodeTable& operator=(const NodeTable&) = delete;

  const quell_node* node() const { return &node_; }

 private:
  static const T& self(const void* instance) { return *static_cast<const T*>(instance); }

  static void reach(const void* instance, quell_reach* out) {
    T copy = self(instance);
    Describe describe(&copy, false);
    copy.describe(describe);
    for (const auto& r : describe.reaches()) *out++ = r;
  }
  static std::int32_t shapes(const void* instance, const quell_spec* spec, quell_shape* out, quell_error* error) {
    return guarded(error, [&] { self(instance).shapes(*spec, out); });
  }
  static std::int32_t prepare(const void* instance, const quell_spec* spec, void** resource, quell_error* error) {
    if constexpr (Prepares<T>) {
      using R = decltype(self(instance).prepare(*spec));
      return guarded(error, [&] { *resource = new R(self(instance).prepare(*spec)); });
    }
    return 0;
  }
  static void release(void* resource) {
    if constexpr (Prepares<T>)
      delete static_cast<decltype(std::declval<const T&>().prepare(std::declval<const quell_spec&>()))*>(resource);
  }
  template <class F>
  static auto with_resource([[maybe_unused]] const void* resource, F&& call) {
    if constexpr (Prepares<T>) {
      using R = decltype(std::declval<const T&>().prepare(std::declval<const quell_spec&>()));
      return call(*static_cast<const R*>(resource));
    } else {
      return call();
    }
  }
  static std::int32_t run(const void* instance, const void* resource, const quell_tile* tile, quell_error* error) {
    return guarded(error, [&] {
      with_resource(resource, [&](const auto&... r) { self(instance).run(static_cast<const Tile&>(*tile), r...); });
    });
  }
  static void weigh(const void* instance, const void* resource, const quell_input* in, const quell_run* run,
                    float* exponent) noexcept {
    with_resource(resource, [&](const auto&... r) { self(instance).weigh(in, *run, exponent, r...); });
  }

  T prototype_{};
  Describe described_;
  std::vector<quell_port> inputs_, outputs_;
  std::vector<quell_param> params_;
  quell_node node_{};
};

}  // namespace quell

#ifndef QUELL_PLUGIN_SYMBOL  // quell_add_plugin names it when plugins are linked into the program
#define QUELL_PLUGIN_SYMBOL quell_plugin
#endif
#ifndef QUELL_PLUGIN_VERSION
#define QUELL_PLUGIN_VERSION "1.0"
#endif
#if defined(__GNUC__)
#define QUELL_EXPORT extern "C" __attribute__((visibility("default")))
#else
#define QUELL_EXPORT extern "C"
#endif

#define QUELL_PLUGIN(NAME, STRUCT)                                                      \
  QUELL_EXPORT const quell_plugin_table* QUELL_PLUGIN_SYMBOL(void) {                    \
    static const quell::NodeTable<STRUCT> table(NAME);                                  \
    static const quell_node* const nodes[] = {table.node()};                            \
    static const quell_plugin_table plugin = {                                          \
        QUELL_MAGIC, QUELL_ABI_MAJOR, QUELL_ABI_MINOR,      sizeof(quell_plugin_table), \
        1,           nodes,           QUELL_PLUGIN_VERSION, __VERSION__};               \
    return &plugin;                                                                     \
  }
