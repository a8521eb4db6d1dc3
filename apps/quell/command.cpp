// Options and steps that subcommands share.
#include "apps/quell/command.h"

#include "core/graph/params.h"
#include "core/json/json.h"
#include "core/report/suggest.h"
#include "core/run/node_source.h"
#include "core/sequence/image_file.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <cstdio>

namespace quell {

namespace fs = std::filesystem;

#ifdef QUELL_STATIC_PLUGIN_LIST
#define QUELL_STATIC_PLUGIN(name) extern "C" const quell_plugin_table* quell_plugin_##name(void);
#include QUELL_STATIC_PLUGIN_LIST
#undef QUELL_STATIC_PLUGIN
#endif

void PluginOptions::add_to(CLI::App& app) {
  app.add_option("--plugins", folders,
                 "Folder of plugins, searched before those installed; may be given more than once.")
      ->type_name("DIR");
}

void GraphOptions::add_to(CLI::App& app) {
  app.add_option("graph", graph, "A graph file, or the name of an installed graph such as svgf.")
      ->required()
      ->type_name("GRAPH");
  const auto list = [&](const char* name, std::vector<std::string>& into, const char* doc, const char* form) {
    app.add_option(name, into, doc)
        ->type_name(form)
        ->take_all()
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->group("Edits of the graph");
  };
  list("--set", set, "Sets a parameter of the graph or of a node.", "NAME=VALUE");
  list("--swap", swap, "Replaces a node by one of another type; wires whose name and type fit are kept.", "NODE=TYPE");
  list("--wire", wire, "Connects an input port.", "NODE.PORT=WIRE");
  list("--bypass", bypass, "Takes a node out; what it passes stands in for it.", "NODE");
  list("--tap", tap, "Writes this buffer too.", "NODE.PORT");
}

void SequenceOptions::add_to(CLI::App& app, bool required) {
  auto* option = app.add_option(
      "sequence", sequence,
      "A sequence file, a pattern of files that a known renderer wrote (beauty.####.exr), or the name of a "
      "built-in sequence such as room.");
  option->type_name("SEQUENCE");
  if (required) option->required();
  app.add_option("--frames", frames, "Frames to run, in place of the sequence's own: 1-20, 1-10x2, 1,5,7-9.")
      ->type_name("RANGE");
  app.add_option("--root", root, "Folder that the sequence's files are relative to.")->type_name("DIR");
  app.add_option("--missing", missing, "What to do about a missing frame: error, skip, hold or black.")
      ->type_name("POLICY")
      ->capture_default_str();
  app.add_option("--source", source, "Sets a parameter of the sequence's source node.")
      ->type_name("NAME=VALUE")
      ->take_all()
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

Commander::Commander(const PluginOptions& plugins)
    : locations_(find_locations(plugins.folders)), registry_(locations_.plugins) {
  quiet_image_threads();
#ifdef QUELL_STATIC_PLUGIN_LIST
#define QUELL_STATIC_PLUGIN(name) registry_.add_static(quell_plugin_##name());
#include QUELL_STATIC_PLUGIN_LIST
#undef QUELL_STATIC_PLUGIN
#endif
}

std::optional<Sequence> Commander::load(const SequenceOptions& options) {
  SequenceRequest request;
  request.path = options.sequence;
  // A bare name is a built-in sequence when there is one.
  if (options.sequence.find_first_of("/.#@%") == std::string::npos)
    if (const auto built_in = locations_.graphs / "sequences" / (options.sequence + ".json"); fs::exists(built_in))
      request.path = built_in.string();
  if (!options.frames.empty()) request.frames = options.frames;
  if (!options.root.empty()) request.root = options.root;
  request.profiles = locations_.graphs / "profiles";
  return load_sequence(request, diagnostics_);
}

std::optional<Graph> Commander::load(const GraphOptions& options, const Sequence* sequence, GraphInfo* info) {
  GraphRequest request;
  request.graph = options.graph;
  request.graphs = locations_.graphs;
  const auto edits = [&](Edit::Kind kind, const std::vector<std::string>& texts) {
    for (const auto& text : texts) request.edits.push_back({kind, text});
  };
  edits(Edit::Kind::swap, options.swap);
  edits(Edit::Kind::wire, options.wire);
  edits(Edit::Kind::set, options.set);
  edits(Edit::Kind::bypass, options.bypass);
  edits(Edit::Kind::tap, options.tap);
  if (sequence) {
    request.roles = sequence->roles();
    if (sequence->source)
      if (const auto* type = registry_.find(sequence->source->type))
        for (const auto& port : type->outputs()) (*request.roles)[port.name] = port.type;
  }
  return load_graph(request, registry_, diagnostics_, info);
}

Instance Commander::source_instance(const SourceNode& source, const std::vector<std::string>& edits) {
  const auto* type = registry_.find(source.type);
  if (!type) {
    const auto* problem = registry_.problem(source.type);
    if (problem) throw Error(Exit::plugin, fmt::format("{}: {}", problem->file.string(), problem->text));
    const auto names = registry_.names();
    throw Error(Exit::usage, fmt::format("the sequence's source '{}' is no node type\n  {}", source.type,
                                         possibilities("there are", source.type, names)));
  }
  Instance instance(*type);
  Faults faults(diagnostics_);
  const Library library(locations_.graphs, faults);
  const auto assign_one = [&](const std::string& name, const Json& value, const std::string& where, bool trusted) {
    const int param = type->find_param(name);
    if (param < 0) {
      std::vector<std::string> names;
      for (const auto& p : type->params()) names.emplace_back(p.name);
      diagnostics_.error(value.position, where, fmt::format("node type '{}' has no parameter '{}'", type->name(), name),
                         {possibilities("it has", name, names)});
      return;
    }
    if (auto problem = assign(instance, param, value, trusted, library); !problem.text.empty())
      diagnostics_.error(value.position, where, problem.text, problem.notes);
  };
  if (source.set)
    for (const auto& member : source.set->members)
      assign_one(member.key, member.value, "source.set." + member.key, true);
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const auto equals = edits[i].find('=');
    if (equals == std::string::npos)
      throw Error(Exit::usage, fmt::format("--source {}: expected NAME=VALUE, as in --source width=1920", edits[i]));
    const auto name = edits[i].substr(0, equals), text = edits[i].substr(equals + 1);
    const int param = type->find_param(name);
    const int kind = param < 0 ? 0 : type->params()[std::size_t(param)].kind;
    const bool bare = kind == QUELL_TEXT || kind == QUELL_PATH || kind == QUELL_CHOICE;
    auto value =
        parse_json(fmt::format("--source #{}", i + 1), bare ? fmt::format("\"{}\"", text) : text, diagnostics_);
    if (value) assign_one(name, *value, "source." + name, true);
  }
  // Defaults may name installed files too.
  for (std::size_t p = 0; p < type->params().size(); ++p)
    if (type->params()[p].kind == QUELL_PATH)
      if (const auto file = library.installed(std::string(instance.get_text(int(p)))))
        instance.set_text(int(p), file->string());
  return instance;
}

std::unique_ptr<FrameSource> Commander::open(const Sequence& sequence, const SequenceOptions& options,
                                             const std::vector<std::string>& roles, int threads,
                                             const std::atomic<bool>* cancel) {
  if (!sequence.source) {
    if (!options.source.empty())
      throw Error(Exit::usage,
                  fmt::format("--source {}: this sequence is made of files and has no source node", options.source[0]));
    const auto missing = missing_from_name(options.missing);
    if (!missing)
      throw Error(Exit::usage, fmt::format("--missing {}: expected error, skip, hold or black", options.missing));
    return open_sequence(sequence, roles, *missing, diagnostics_);
  }
  auto instance = source_instance(*sequence.source, options.source);
  if (!diagnostics_.ok()) return nullptr;
  return std::make_unique<NodeSource>(std::move(instance), sequence.frames, sequence.cuts, threads, cancel);
}

int Commander::report() {
  std::fputs(diagnostics_.format().c_str(), stderr);
  return diagnostics_.ok() ? 0 : int(registry_.problems().empty() ? Exit::usage : Exit::plugin);
}

}  // namespace quell
