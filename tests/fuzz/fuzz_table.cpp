// Any table whose counts are true is refused with reasons or makes instances that stay within their memory.
#include "core/plugin/node_type.h"
#include "core/plugin/registry.h"

#include <fuzzer/FuzzedDataProvider.h>

#include <cstdlib>
#include <deque>
#include <string>
#include <vector>

namespace {

std::int32_t run(const void*, const void*, const quell_tile*, quell_error*) { return 0; }
void weigh(const void*, const void*, const quell_input*, const quell_run*, float*) {}
std::int32_t shapes(const void*, const quell_spec*, quell_shape*, quell_error*) { return 0; }

// Builds a node out of bytes. Everything that the table points to is there, in memory of exactly that size.
class Builder {
 public:
  explicit Builder(FuzzedDataProvider& bytes) : bytes_(bytes) {}

  quell_node node() {
    quell_node n{};
    n.size = maybe(std::uint32_t{sizeof n});
    n.name = text(), n.summary = text(), n.source = text();
    n.in = ports(n.in_count), n.out = ports(n.out_count);
    n.instance_size = bytes_.ConsumeIntegralInRange<std::size_t>(0, 64);
    n.instance_align = bytes_.PickValueInArray<std::size_t>({8, 16, 4, 1, 3, 0});
    auto& defaults = memory_.emplace_back(bytes_.ConsumeBytes<std::uint8_t>(n.instance_size));
    defaults.resize(n.instance_size);
    defaults.shrink_to_fit();
    n.defaults = bytes_.ConsumeBool() ? defaults.data() : nullptr;
    n.param = params(n.param_count);
    n.shapes = bytes_.ConsumeBool() ? &shapes : nullptr;
    n.run = bytes_.ConsumeBool() ? &run : nullptr;
    n.weigh = bytes_.ConsumeBool() ? &weigh : nullptr;
    return n;
  }

 private:
  template <class T>
  T maybe(T good) {
    return bytes_.ConsumeIntegralInRange(0, 15) ? good : bytes_.ConsumeIntegral<T>();
  }
  const char* text() {
    const int choice = bytes_.ConsumeIntegralInRange(0, 15);
    if (choice == 0) return nullptr;
    if (choice > 2) return bytes_.PickValueInArray({"a", "b", "c", "d"});
    return texts_.emplace_back(bytes_.ConsumeRandomLengthString(8)).c_str();
  }
  const quell_port* ports(std::int32_t& count) {
    auto& list = ports_.emplace_back(bytes_.ConsumeIntegralInRange<std::size_t>(0, 4));
    for (auto& p : list)
      p = {text(),
           text(),
           bytes_.ConsumeIntegralInRange(0, 21),
           bytes_.ConsumeIntegralInRange(0u, 4u),
           bytes_.ConsumeIntegralInRange(-2, 4),
           bytes_.ConsumeIntegralInRange(-2, 4)};
    count = std::int32_t(list.size());
    return list.data();
  }
  const quell_param* params(std::int32_t& count) {
    auto& list = params_.emplace_back(bytes_.ConsumeIntegralInRange<std::size_t>(0, 4));
    for (auto& p : list) {
      auto& names = choices_.emplace_back(bytes_.ConsumeIntegralInRange<std::size_t>(0, 3));
      for (auto& name : names) name = text();
      p = {text(),
           text(),
           bytes_.ConsumeIntegralInRange(0, 8),
           maybe(1),
           bytes_.ConsumeIntegralInRange<std::size_t>(0, 72),
           bytes_.ConsumeFloatingPoint<double>(),
           bytes_.ConsumeFloatingPoint<double>(),
           names.data(),
           std::int32_t(names.size()),
           0};
    }
    count = std::int32_t(list.size());
    return list.data();
  }

  FuzzedDataProvider& bytes_;
  std::deque<std::string> texts_;
  std::deque<std::vector<quell_port>> ports_;
  std::deque<std::vector<quell_param>> params_;
  std::deque<std::vector<const char*>> choices_;
  std::deque<std::vector<std::uint8_t>> memory_;
};

bool has_text(const quell_node& n) {
  for (std::int32_t i = 0; i < n.param_count; ++i)
    if (n.param[i].kind == QUELL_TEXT || n.param[i].kind == QUELL_PATH) return true;
  return false;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider bytes(data, size);
  Builder builder(bytes);
  const quell_node nodes[] = {builder.node(), builder.node()};
  const quell_node* const list[] = {&nodes[0], &nodes[1]};
  const quell_plugin_table table{
      QUELL_MAGIC, QUELL_ABI_MAJOR, QUELL_ABI_MINOR, sizeof table, bytes.ConsumeIntegralInRange(0, 2), list, "1", "1"};
  if (!quell::validate(&table).empty()) return 0;
  for (std::int32_t i = 0; i < table.node_count; ++i) {
    const quell::NodeType type(list[i], &table, "");
    if (has_text(*list[i])) continue;  // the bytes of a default text are no pointer to read
    const quell::Instance instance(type);
    const quell::Instance copy = instance;
    if (copy.describe() != instance.describe()) std::abort();
    if (copy.reach().size() != type.inputs().size()) std::abort();
  }
  return 0;
}
