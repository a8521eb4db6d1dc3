// Look-up of ports and parameters by name, and instances.
#include "core/plugin/node_type.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>

namespace quell {

namespace {

template <class T>
int find(std::span<const T> list, std::string_view name) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].name == name) return int(i);
  return -1;
}

}  // namespace

int NodeType::find_input(std::string_view name) const { return find(inputs(), name); }
int NodeType::find_output(std::string_view name) const { return find(outputs(), name); }
int NodeType::find_param(std::string_view name) const { return find(params(), name); }

bool NodeType::shares_type(const quell_port& input) const {
  return !(input.flags & QUELL_LIST) ||
         std::ranges::any_of(outputs(), [](const quell_port& o) { return o.type == QUELL_ANY; });
}

void Instance::Free::operator()(std::byte* p) const { std::free(p); }

Instance::Instance(const NodeType& type) : type_(&type) {
  const auto& t = type.table();
  const std::size_t align = std::max(t.instance_align, alignof(std::max_align_t));
  const std::size_t size = std::max<std::size_t>(1, (t.instance_size + align - 1) / align * align);
  bytes_.reset(static_cast<std::byte*>(std::aligned_alloc(align, size)));
  if (!bytes_) throw std::bad_alloc();
  std::memcpy(bytes_.get(), t.defaults, t.instance_size);
}

Instance::Instance(const Instance& other) : Instance(*other.type_) {
  std::memcpy(bytes_.get(), other.bytes_.get(), type_->table().instance_size);
  for (const auto& [param, text] : other.texts_) set_text(param, text);
}

std::byte* Instance::at(int param) { return bytes_.get() + type_->params()[std::size_t(param)].offset; }
const std::byte* Instance::at(int param) const { return bytes_.get() + type_->params()[std::size_t(param)].offset; }

void Instance::set_bool(int param, bool value) { *reinterpret_cast<std::uint8_t*>(at(param)) = value ? 1 : 0; }
void Instance::set_int(int param, int value) { std::memcpy(at(param), &value, sizeof value); }
void Instance::set_float(int param, float value) { std::memcpy(at(param), &value, sizeof value); }
void Instance::set_floats(int param, std::span<const float> values) {
  std::memcpy(at(param), values.data(), std::size_t(type_->params()[std::size_t(param)].count) * sizeof(float));
}
void Instance::set_text(int param, std::string value) {
  auto it = std::ranges::find(texts_, param, &std::pair<int, std::string>::first);
  if (it == texts_.end()) it = texts_.emplace(texts_.end(), param, std::string());
  it->second = std::move(value);
  const quell_text text{it->second.c_str(), it->second.size()};
  std::memcpy(at(param), &text, sizeof text);
}

bool Instance::get_bool(int param) const { return *reinterpret_cast<const std::uint8_t*>(at(param)) != 0; }
int Instance::get_int(int param) const {
  int value;
  std::memcpy(&value, at(param), sizeof value);
  return value;
}
float Instance::get_float(int param) const {
  float value;
  std::memcpy(&value, at(param), sizeof value);
  return value;
}
std::span<const float> Instance::get_floats(int param) const {
  return {reinterpret_cast<const float*>(at(param)), std::size_t(type_->params()[std::size_t(param)].count)};
}
std::string_view Instance::get_text(int param) const {
  quell_text text;
  std::memcpy(&text, at(param), sizeof text);
  return {text.data, text.size};
}

std::string Instance::describe() const {
  std::string out;
  for (std::size_t i = 0; i < type_->params().size(); ++i) {
    const auto& p = type_->params()[i];
    const int n = int(i);
    if (!out.empty()) out += ' ';
    out += p.name;
    out += '=';
    switch (p.kind) {
      case QUELL_BOOL:
        out += get_bool(n) ? "true" : "false";
        break;
      case QUELL_INT:
        out += fmt::format("{}", get_int(n));
        break;
      case QUELL_FLOAT:
        out += fmt::format("{}", get_float(n));
        break;
      case QUELL_CHOICE:
        out += p.choices[get_int(n)];
        break;
      case QUELL_FLOATS:
        out += fmt::format("[{}]", fmt::join(get_floats(n), ","));
        break;
      default:
        out += fmt::format("{:?}", std::string(get_text(n)));
        break;
    }
  }
  return out;
}

std::vector<quell_reach> Instance::reach() const {
  std::vector<quell_reach> reach(type_->inputs().size());
  if (type_->table().reach && !reach.empty()) type_->table().reach(data(), reach.data());
  return reach;
}

}  // namespace quell
