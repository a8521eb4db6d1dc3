// Names and types of targets.
#include "core/graph/net.h"

namespace quell {

std::string Net::name_of(const Target& t) const {
  const auto i = std::size_t(t.index);
  switch (t.kind) {
    case Target::Kind::node:
      return nodes[i].name + "." + nodes[i].type->outputs()[std::size_t(t.port)].name;
    case Target::Kind::input:
      return inputs[i].name;
    case Target::Kind::alias:
      return aliases[i].name;
    case Target::Kind::none:
      break;
  }
  return "";
}

int Net::type_of(const Target& t) const {
  if (t.kind == Target::Kind::input) return inputs[std::size_t(t.index)].type;
  if (t.kind == Target::Kind::node) return nodes[std::size_t(t.index)].out_types[std::size_t(t.port)];
  return 0;
}

std::string Net::path(const NetNode& node, std::size_t port) const {
  return node.name + ".in." + node.type->inputs()[port].name;
}

}  // namespace quell
