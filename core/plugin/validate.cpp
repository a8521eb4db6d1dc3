// Checks a plugin's whole table before any of its nodes is registered.
#include "core/plugin/registry.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <cmath>
#include <cstring>

namespace quell {

namespace {

constexpr int kMaxEntries = 4096;
constexpr std::size_t kMaxInstance = 1u << 20;

bool is_name(const char* s) {
  if (!s || *s < 'a' || *s > 'z') return false;
  for (; *s; ++s)
    if (!((*s >= 'a' && *s <= 'z') || (*s >= '0' && *s <= '9') || *s == '_')) return false;
  return true;
}
std::string shown(const char* s) { return s ? fmt::format("'{}'", s) : "(null)"; }

bool counted(const void* list, int count) { return count >= 0 && count <= kMaxEntries && (count == 0 || list); }

// Bytes that a parameter takes in the instance; 0 for a kind or a count that there is not.
std::size_t bytes_of(const quell_param& p) {
  if (p.kind == QUELL_FLOATS) return p.count > 0 ? std::size_t(p.count) * sizeof(float) : 0;
  if (p.count != 1) return 0;
  switch (p.kind) {
    case QUELL_BOOL:
      return sizeof(std::uint8_t);
    case QUELL_INT:
    case QUELL_CHOICE:
      return sizeof(std::int32_t);
    case QUELL_FLOAT:
      return sizeof(float);
    case QUELL_TEXT:
    case QUELL_PATH:
      return sizeof(quell_text);
    default:
      return 0;
  }
}
std::size_t align_of(const quell_param& p) {
  return p.kind == QUELL_BOOL ? 1 : p.kind == QUELL_TEXT || p.kind == QUELL_PATH ? alignof(quell_text) : sizeof(float);
}

class Checker {
 public:
  explicit Checker(std::vector<std::string>& out) : out_(out) {}

  void node(const quell_node* n, int index) {
    where_ = fmt::format("node {}", index);
    if (!n) return bad("is null");
    if (n->size != sizeof(quell_node)) return bad("size is {}, expected {}", n->size, sizeof(quell_node));
    if (!is_name(n->name)) return bad("name {} is not of the form [a-z][a-z0-9_]*", shown(n->name));
    where_ = fmt::format("node '{}'", n->name);
    if (!n->summary || !*n->summary) bad("has no summary");
    if (!n->source) bad("source is null");
    if (!counted(n->in, n->in_count)) return bad("{} inputs at {}", n->in_count, fmt::ptr(n->in));
    if (!counted(n->out, n->out_count)) return bad("{} outputs at {}", n->out_count, fmt::ptr(n->out));
    if (!counted(n->param, n->param_count)) return bad("{} parameters at {}", n->param_count, fmt::ptr(n->param));
    if (n->out_count == 0) bad("has no output");
    if (n->instance_align == 0 || (n->instance_align & (n->instance_align - 1)) || n->instance_align > 4096)
      return bad("instance_align is {}", n->instance_align);
    if (n->instance_size > kMaxInstance) return bad("instance_size is {}", n->instance_size);
    if (!n->defaults && n->instance_size) return bad("defaults is null");
    if (!n->run == !n->weigh) bad("must have exactly one of run and weigh");
    if (!n->prepare != !n->release) bad("must have both or none of prepare and release");
    ports(*n);
    params(*n);
  }

 private:
  template <class... A>
  void bad(fmt::format_string<A...> format, A&&... args) {
    out_.push_back(where_ + ": " + fmt::format(format, std::forward<A>(args)...));
  }

  void port(const quell_port& p, const char* side, int i) {
    if (!is_name(p.name)) return bad("{} {}: name {} is not of the form [a-z][a-z0-9_]*", side, i, shown(p.name));
    if (!p.doc || !*p.doc) bad("{} '{}' has no doc", side, p.name);
    if (p.type != QUELL_ANY && !type_info(p.type)) bad("{} '{}': there is no type {}", side, p.name, p.type);
    if (p.flags & ~(QUELL_OPTIONAL | QUELL_LIST)) bad("{} '{}': unknown flags {:#x}", side, p.name, p.flags);
  }
  template <class T>
  void distinct(const T* list, int count, const char* side) {
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < i; ++j)
        if (list[i].name && list[j].name && !std::strcmp(list[i].name, list[j].name))
          bad("two {}s are called '{}'", side, list[i].name);
  }

  void ports(const quell_node& n) {
    bool any_in = false, image_in = false;
    for (int i = 0; i < n.in_count; ++i) {
      port(n.in[i], "input", i);
      any_in |= n.in[i].type == QUELL_ANY;
      const auto* info = type_info(n.in[i].type);
      image_in |= !info || info->storage == Storage::pixels;
    }
    for (int i = 0; i < n.out_count; ++i) {
      const auto& p = n.out[i];
      port(p, "output", i);
      if (p.flags) bad("output {} has flags", shown(p.name));
      if (p.type == QUELL_ANY && !any_in) bad("output {} is of type any, but no input is", shown(p.name));
      if (p.passes < -1 || p.passes >= n.in_count)
        bad("output {} passes input {} of {}", shown(p.name), p.passes, n.in_count);
      else if (p.passes >= 0 && n.in[p.passes].type != p.type)
        bad("output {} passes an input of another type", shown(p.name));
      if (p.with < -1 || p.with >= n.in_count)
        bad("output {} is with input {} of {}", shown(p.name), p.with, n.in_count);
      if ((p.type == QUELL_WEIGHT) != (n.weigh != nullptr))
        bad("output {}: weight nodes, and only they, give weights", shown(p.name));
    }
    if (n.weigh && n.out_count != 1) bad("a weight node has one output, not {}", n.out_count);
    if (n.weigh)
      for (int i = 0; i < n.in_count; ++i)
        if (n.in[i].type == QUELL_WEIGHT) bad("input {}: a weight node takes no weights", shown(n.in[i].name));
    if (!image_in && !n.shapes && !n.weigh) bad("has no image inputs, so it needs shapes");
    distinct(n.in, n.in_count, "input");
    distinct(n.out, n.out_count, "output");
  }

  void params(const quell_node& n) {
    for (int i = 0; i < n.param_count; ++i) {
      const auto& p = n.param[i];
      if (!is_name(p.name)) {
        bad("parameter {}: name {} is not of the form [a-z][a-z0-9_]*", i, shown(p.name));
        continue;
      }
      if (!p.doc || !*p.doc) bad("parameter '{}' has no doc", p.name);
      const std::size_t bytes = bytes_of(p);
      if (bytes == 0) {
        bad("parameter '{}': kind {} with count {}", p.name, p.kind, p.count);
        continue;
      }
      if (p.offset > n.instance_size || bytes > n.instance_size - p.offset) {
        bad("parameter '{}': offset {} is outside the instance of {} bytes", p.name, p.offset, n.instance_size);
        continue;
      }
      if (p.offset % align_of(p) != 0 || n.instance_align % align_of(p) != 0) {
        bad("parameter '{}': offset {} in an instance aligned to {} is not aligned to {}", p.name, p.offset,
            n.instance_align, align_of(p));
        continue;
      }
      if (!(p.min <= p.max)) bad("parameter '{}': range [{}, {}] is empty", p.name, p.min, p.max);
      const auto* at = static_cast<const std::byte*>(n.defaults) + p.offset;
      if (p.kind == QUELL_BOOL && read<std::uint8_t>(at) > 1)
        bad("parameter '{}': default {} is neither 0 nor 1", p.name, read<std::uint8_t>(at));
      if (p.kind == QUELL_CHOICE) choices(p, at);
      if (p.kind == QUELL_INT) in_range(p, read<std::int32_t>(at));
      if (p.kind == QUELL_FLOAT || p.kind == QUELL_FLOATS)
        for (int k = 0; k < p.count; ++k) in_range(p, read<float>(at + 4 * std::size_t(k)));
      if ((p.kind == QUELL_TEXT || p.kind == QUELL_PATH) && !read<quell_text>(at).data)
        bad("parameter '{}': its default text is null", p.name);
    }
    distinct(n.param, n.param_count, "parameter");
  }
  void choices(const quell_param& p, const std::byte* at) {
    if (!counted(p.choices, p.choice_count) || p.choice_count == 0) return bad("parameter '{}' has no choices", p.name);
    for (int k = 0; k < p.choice_count; ++k)
      if (!p.choices[k] || !*p.choices[k]) bad("parameter '{}': choice {} has no name", p.name, k);
    const int chosen = read<std::int32_t>(at);
    if (chosen < 0 || chosen >= p.choice_count)
      bad("parameter '{}': default {} is none of its {} choices", p.name, chosen, p.choice_count);
  }
  void in_range(const quell_param& p, double value) {
    if (!(value >= p.min && value <= p.max))
      bad("parameter '{}': default {} is outside [{}, {}]", p.name, value, p.min, p.max);
  }
  template <class T>
  static T read(const std::byte* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return value;
  }

  std::vector<std::string>& out_;
  std::string where_;
};

}  // namespace

std::vector<std::string> validate(const quell_plugin_table* table) {
  std::vector<std::string> out;
  if (!table) return {"quell_plugin() returned null"};
  if (table->magic != QUELL_MAGIC)
    return {fmt::format("the table's magic number is {:#010x}, expected {:#010x}", table->magic, QUELL_MAGIC)};
  if (table->abi_major != QUELL_ABI_MAJOR || table->abi_minor > QUELL_ABI_MINOR)
    return {fmt::format("built for plugin ABI {}.{}, this program has {}.{}: rebuild the plugin", table->abi_major,
                        table->abi_minor, QUELL_ABI_MAJOR, QUELL_ABI_MINOR)};
  if (table->size != sizeof(quell_plugin_table))
    return {fmt::format("the table's size is {}, expected {}", table->size, sizeof(quell_plugin_table))};
  if (!table->version || !table->compiler) return {"version or compiler is null"};
  if (!counted(table->nodes, table->node_count) || table->node_count == 0)
    return {fmt::format("{} nodes at {}", table->node_count, fmt::ptr(table->nodes))};
  Checker checker(out);
  for (int i = 0; i < table->node_count; ++i) checker.node(table->nodes[i], i);
  for (int i = 0; out.empty() && i < table->node_count; ++i)
    for (int j = 0; j < i; ++j)
      if (!std::strcmp(table->nodes[i]->name, table->nodes[j]->name))
        out.push_back(fmt::format("two nodes are called '{}'", table->nodes[i]->name));
  return out;
}

}  // namespace quell
