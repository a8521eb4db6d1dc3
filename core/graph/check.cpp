// All of a graph's type errors and missing wires at once.
#include "core/graph/check.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>

namespace quell {

namespace {

bool float_image(int type) {
  const auto* info = type_info(type);
  return info && info->storage == Storage::pixels && !info->integer && type != QUELL_TAPS;
}

// Equal memory: a cast changes the meaning, never the data.
bool castable(int from, int to) {
  if (from == to) return true;
  if (!float_image(from) || !float_image(to)) return false;
  const int a = type_info(from)->channels, b = type_info(to)->channels;
  return a == b || a == 0 || b == 0;
}

class Checker {
 public:
  Checker(Net& net, const std::optional<Roles>& roles, Faults& faults) : net_(net), roles_(roles), faults_(faults) {}

  void run() {
    for (const auto& a : net_.aliases)
      if (a.type)
        for (const auto& l : a.links) link(l, a.type, input_path(a.name), a.name.substr(a.name.rfind('.') + 1));
    if (!faults_.ok()) return;  // what is wrong at a subgraph's boundary would be said again for each reader within
    for (auto& n : net_.nodes)
      if (!n.spec->bypass) node(n);
    if (faults_.ok()) untold();
    for (const auto& o : net_.outputs) output(o);
  }

 private:
  // Input "level0.image" is "level0.in.image" in messages.
  static std::string input_path(std::string name) { return name.insert(name.rfind('.'), ".in"); }

  // The link is sound in itself and gives `wanted`.
  bool link(const Link& l, int wanted, const std::string& path, std::string_view reader) {
    const int own = net_.type_of(l.from);
    if (own == 0) return true;  // said where it cannot be inferred
    const std::string name = net_.name_of(l.from);
    if (l.as && !castable(own, l.as)) {
      faults_.error(l.position, path,
                    fmt::format("'{}' is {} and cannot be taken as {}", name, type_name(own), type_name(l.as)),
                    {"a cast keeps the data: both are float images of as many channels"});
      return false;
    }
    const int type = l.as ? l.as : own;
    if (type == QUELL_WEIGHT && l.delay > 0) {
      faults_.error(l.position, path, fmt::format("'{}' is a weight and cannot be delayed", name),
                    {"a weight makes no image that could be kept; delay what it reads"});
      return false;
    }
    if (type != wanted) {
      std::vector<std::string> notes;
      if (castable(own, wanted))
        notes.push_back(
            fmt::format("if that is meant: {{ \"from\": \"{}\", \"as\": \"{}\" }}", name, type_name(wanted)));
      faults_.error(l.position, path,
                    fmt::format("'{}' is {}, but '{}' takes {}", name, type_name(type), reader, type_name(wanted)),
                    notes);
      return false;
    }
    if (l.start.kind != Target::Kind::none && net_.type_of(l.start) != type && net_.type_of(l.start) != 0) {
      faults_.error(l.position, path,
                    fmt::format("the start '{}' is {}, but '{}' is {}", net_.name_of(l.start),
                                type_name(net_.type_of(l.start)), name, type_name(type)));
      return false;
    }
    return true;
  }

  void node(NetNode& n) {
    if (n.spec->swapped) refit(n);
    int variable = 0;
    bool told = false;
    std::string by;
    for (std::size_t p = 0; p < n.in.size(); ++p) {
      const auto& port = n.type->inputs()[p];
      const bool list = (port.flags & QUELL_LIST) != 0;
      for (std::size_t i = 0; i < n.in[p].links.size(); ++i) {
        const auto& l = n.in[p].links[i];
        int alone = 0;
        const std::string path =
            list && n.in[p].links.size() > 1 ? fmt::format("{}[{}]", net_.path(n, p), i) : net_.path(n, p);
        if (port.type != QUELL_ANY)
          link(l, port.type, path, port.name);
        else
          any(n, port.name, l, path, n.type->shares_type(port) ? variable : alone, by), told = true;
      }
      if (n.in[p].links.empty() && !(port.flags & (QUELL_OPTIONAL | QUELL_LIST))) missing(n, p), told = true;
    }
    if (!told) unbound(n);
  }

  // All of a node's inputs of type any may be optional.
  void unbound(const NetNode& n) {
    for (std::size_t o = 0; o < n.out_types.size(); ++o)
      if (n.out_types[o] == 0)
        faults_.error(n.spec->position, n.name,
                      fmt::format("nothing tells the type of its output '{}'", n.type->outputs()[o].name),
                      {"connect one of its inputs of type any"});
  }

  void any(const NetNode& n, std::string_view port, const Link& l, const std::string& path, int& variable,
           std::string& by) {
    const int type = net_.type_of(l);
    const std::string name = net_.name_of(l.from);
    if (type == 0) {
      untold_.push_back({l, path});
      return;
    }
    if (!float_image(type)) {
      faults_.error(l.position, path,
                    fmt::format("'{}' is {}, but '{}' takes an image of numbers", name, type_name(type), port));
      return;
    }
    if (!link(l, type, path, port)) return;
    if (variable == 0) variable = type, by = port;
    if (variable != type)
      faults_.error(l.position, path,
                    fmt::format("'{}' is {}, but '{}' of '{}' is {}, and both must have one type", name,
                                type_name(type), by, n.name, type_name(variable)));
  }

  // Said only where nothing else is wrong, for that may be why.
  void untold() {
    for (const auto& [link, path] : untold_)
      faults_.error(
          link.position, path, fmt::format("nothing tells the type of '{}'", net_.name_of(link.from)),
          {"every wire into it comes from itself; one must come from a node or input of known type, or say \"as\""});
  }

  void missing(const NetNode& n, std::size_t p) {
    const auto& port = n.type->inputs()[p];
    const auto& in = n.in[p];
    const std::string takes = fmt::format("it takes {}: {}", type_name(port.type), port.doc);
    if (in.written) {
      faults_.error(in.position, net_.path(n, p),
                    fmt::format("'{}' of '{}' is required, but {}", port.name, n.type->name(), in.absent), {takes});
    } else if (n.spec->swapped) {
      std::vector<std::string> ports;
      for (const auto& i : n.type->inputs()) ports.push_back(fmt::format("{} ({})", i.name, type_name(i.type)));
      faults_.error(n.spec->type_position, n.name,
                    fmt::format("'{}' needs '{}', which nothing provides", n.type->name(), port.name),
                    {fmt::format("its inputs: {}", fmt::join(ports, ", ")),
                     fmt::format("wire it: {}.{} = node.port", n.name, port.name)});
    } else {
      faults_.error(n.spec->position, n.name,
                    fmt::format("input '{}' of '{}' is not connected", port.name, n.type->name()), {takes});
    }
  }

  void refit(NetNode& n) {
    for (std::size_t p = 0; p < n.in.size(); ++p) {
      const int wanted = n.type->inputs()[p].type;
      if (wanted == QUELL_ANY || (!n.in[p].links.empty() && from_change(n, p))) continue;
      std::erase_if(n.in[p].links, [&](const Link& l) { return net_.type_of(l) != wanted; });
      if (n.in[p].links.empty()) n.in[p].written = false;
    }
    fill_swapped(net_, n, roles_);
  }
  // Written for the new type, not left over from the old one.
  static bool from_change(const NetNode& n, std::size_t p) {
    for (const auto& b : n.spec->in)
      if (b.port == n.type->inputs()[p].name && !b.wires.empty()) return b.wires[0].scope >= 0;
    return false;
  }

  void output(const NetOutput& o) {
    const std::string path = o.tap ? "" : "outputs." + o.name;
    if (o.links.size() != 1) {
      faults_.error(o.position, path,
                    o.links.empty() ? fmt::format("there is nothing to write: {}", o.absent)
                                    : "an output is one wire, not a list");
      return;
    }
    const auto& l = o.links[0];
    const int type = net_.type_of(l);
    if (type == 0) return;  // which has been said of the node
    if (type == QUELL_WEIGHT)
      faults_.error(l.position, path,
                    fmt::format("'{}' is a weight; there is no image to write", net_.name_of(l.from)));
    else
      link(l, type, path, o.name);
  }

  // A wire whose type is not known.
  struct Untold {
    Link link;
    std::string path;
  };

  Net& net_;
  const std::optional<Roles>& roles_;
  Faults& faults_;
  std::vector<Untold> untold_;
};

}  // namespace

void check(Net& net, const std::optional<Roles>& roles, Faults& faults) {
  infer_types(net);
  Checker(net, roles, faults).run();
}

}  // namespace quell
