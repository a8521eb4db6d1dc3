// quell nodes: what nodes there are, and what each takes and gives.
#include "apps/quell/command.h"

#include "core/graph/schema.h"
#include "core/plugin/document.h"
#include "core/report/suggest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace quell {

namespace {

struct NodesArguments {
  PluginOptions plugins;
  std::string name;
  bool json = false, markdown = false, schema = false, problems = false;
};

void print_problems(const Registry& registry) {
  for (const auto& p : registry.problems()) fmt::print(stderr, "{}: error: {}\n", p.file.string(), p.text);
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::ranges::transform(out, out.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return out;
}

// A technique may go by a name that is no node's: "box" is a kernel of several, "bilateral" is a filter and weights.
std::string mentions(const std::string& word, Registry& registry) {
  constexpr std::size_t kShortest = 3;
  std::vector<std::string> settings, nodes;
  for (const auto* type : registry.all()) {
    for (const auto& p : type->params())
      for (int c = 0; c < p.choice_count; ++c)
        if (word == p.choices[c]) settings.push_back(fmt::format("{}.{}", type->name(), p.name));
    if (word.size() >= kShortest && lower(document_text(*type)).find(lower(word)) != std::string::npos)
      nodes.emplace_back(type->name());
  }
  std::string text;
  if (!settings.empty()) text += fmt::format("\n  '{}' is a value of {}", word, fmt::join(settings, ", "));
  if (!nodes.empty()) text += fmt::format("\n  '{}' is spoken of in {}", word, fmt::join(nodes, ", "));
  return text;
}

int nodes(const NodesArguments& a) {
  Commander commander(a.plugins);
  auto& registry = commander.registry();
  std::vector<const NodeType*> types;
  if (a.name.empty()) {
    types = registry.all();
  } else if (const auto* type = registry.find(a.name)) {
    types.push_back(type);
  } else if (const auto* problem = registry.problem(a.name)) {
    throw Error(Exit::plugin, fmt::format("{}: {}", problem->file.string(), problem->text));
  } else {
    const auto names = registry.names();
    throw Error(Exit::usage, fmt::format("there is no node type '{}'\n  {}{}", a.name,
                                         possibilities("there are", a.name, names), mentions(a.name, registry)));
  }
  // Whoever asks about plugins wants to know of all that is wrong; who asks for all nodes, of nothing else.
  if (a.problems || a.name.empty()) print_problems(registry);
  if (a.problems) {
    for (const auto& folder : registry.folders()) fmt::print("{}\n", folder.string());
    return registry.problems().empty() ? 0 : int(Exit::plugin);
  }
  if (a.schema) {
    fmt::print("{}", graph_schema(registry));
  } else if (a.json) {
    fmt::print("[");
    for (std::size_t i = 0; i < types.size(); ++i) fmt::print("{}\n{}", i ? "," : "", document_json(*types[i]));
    fmt::print("\n]\n");
  } else if (a.markdown) {
    for (const auto* type : types) fmt::print("{}\n", document_markdown(*type));
  } else if (!a.name.empty()) {
    fmt::print("{}", document_text(*types[0]));
  } else {
    for (const auto* type : types) fmt::print("{:<20} {}\n", type->name(), type->table().summary);
  }
  return 0;
}

}  // namespace

void add_nodes(CLI::App& app, int& exit) {
  auto* sub = app.add_subcommand("nodes", "Lists the nodes that there are, or tells all about one.");
  auto a = std::make_shared<NodesArguments>();
  sub->add_option("name", a->name, "A node type; without, all of them.")->type_name("NAME");
  auto* json = sub->add_flag("--json", a->json, "As JSON.");
  auto* markdown = sub->add_flag("--markdown", a->markdown, "As Markdown.")->excludes(json);
  sub->add_flag("--schema", a->schema, "As a JSON schema, with which an editor completes and checks graph files.")
      ->excludes(json)
      ->excludes(markdown);
  sub->add_flag("--problems", a->problems, "Lists the folders of plugins, and what is wrong in them.");
  a->plugins.add_to(*sub);
  sub->footer(
      "Examples:\n  quell nodes\n  quell nodes atrous\n  quell nodes --schema > graph.schema.json\n"
      "  then, in a graph file: \"$schema\": \"graph.schema.json\"");
  sub->callback([a, &exit] { exit = nodes(*a); });
}

}  // namespace quell
