// Options and steps that subcommands share.
#include "apps/quell/command.h"

#include "apps/quell/options.h"

#include "core/json/json.h"
#include "core/report/suggest.h"
#include "core/run/node_source.h"
#include "core/run/source_node.h"
#include "core/sequence/image_file.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace quell {

namespace fs = std::filesystem;

namespace {

bool is_folder(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

}  // namespace

#ifdef QUELL_STATIC_PLUGIN_LIST
#define QUELL_STATIC_PLUGIN(name) extern "C" const quell_plugin_table* quell_plugin_##name(void);
#include QUELL_STATIC_PLUGIN_LIST
#undef QUELL_STATIC_PLUGIN
#endif

void PluginOptions::add_to(CLI::App& app) {
  repeatable(app.add_option("--plugins", folders,
                            "Folder of plugins, searched before those installed; may be given more than once."))
      ->type_name("DIR");
}

void GraphOptions::add_to(CLI::App& app) {
  app.add_option("graph", graph, "A graph file, or the name of an installed graph such as svgf.")
      ->required()
      ->type_name("GRAPH");
  const auto list = [&](const char* name, std::vector<std::string>& into, const char* doc, const char* form) {
    repeatable(app.add_option(name, into, doc))->type_name(form)->group("Edits of the graph");
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
      ->type_name("RANGE")
      ->check([](const std::string& text) {
        return std::string(text.empty() ? "is empty; leave it out for all frames" : "");
      });
  app.add_option("--root", root, "Folder that the sequence's files are relative to.")->type_name("DIR");
  offers_missing = true;
  app.add_option("--missing", missing,
                 "What to do about a frame whose files are missing: end with an error, leave it out, hold the frame "
                 "before, or take it as black.")
      ->check(one_of({std::begin(kMissingNames), std::end(kMissingNames)}))
      ->type_name("")
      ->capture_default_str();
  repeatable(app.add_option("--source", source, "Sets a parameter of the sequence's source node."))
      ->type_name("NAME=VALUE");
}

Commander::Commander(const PluginOptions& plugins)
    : locations_(find_locations(plugins.folders)), registry_(locations_.plugins) {
  for (const auto& folder : plugins.folders)
    if (!is_folder(folder)) throw Error(Exit::plugin, fmt::format("--plugins {}: there is no such folder", folder));
#ifdef QUELL_STATIC_PLUGIN_LIST
#define QUELL_STATIC_PLUGIN(name) registry_.add_static(quell_plugin_##name());
#include QUELL_STATIC_PLUGIN_LIST
#undef QUELL_STATIC_PLUGIN
#endif
}

// The file or pattern that SEQUENCE means: a bare name is a built-in sequence when there is one.
std::optional<std::string> Commander::sequence_path(const SequenceOptions& options) {
  const auto& name = options.sequence;
  std::error_code error;
  if (name.find_first_of("/.#@%") != std::string::npos || fs::exists(name, error)) return name;
  const auto built_in = locations_.graphs / "sequences";
  if (const auto file = built_in / (name + ".json"); fs::exists(file, error)) return file.string();
  std::vector<std::string> names;
  for (fs::directory_iterator it(built_in, error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == ".json") names.push_back(it->path().stem().string());
  std::ranges::sort(names);
  diagnostics_.error({}, "", fmt::format("there is no sequence '{}'", name),
                     {possibilities("built in are", name, names),
                      "others are files (shot.json), patterns (beauty.####.exr) or folders"});
  return std::nullopt;
}

std::optional<Sequence> Commander::load(const SequenceOptions& options) {
  const auto path = sequence_path(options);
  if (!path) return std::nullopt;
  SequenceRequest request;
  request.path = *path;
  if (!options.frames.empty()) request.frames = options.frames;
  if (!options.root.empty()) {
    if (!path->ends_with(".json"))
      throw Error(Exit::usage, fmt::format("--root {}: only a sequence file names files that are relative to a folder",
                                           options.root));
    if (!is_folder(options.root))
      throw Error(Exit::input, fmt::format("--root {}: there is no such folder", options.root));
    request.root = options.root;
  }
  return load(std::move(request));
}

std::optional<Sequence> Commander::load(SequenceRequest request) {
  request.profiles = locations_.graphs / "profiles";
  auto sequence = load_sequence(request, diagnostics_);
  if (sequence && sequence->source && request.root)
    throw Error(Exit::usage,
                fmt::format("--root {}: this sequence is made by a source node and names no files", *request.root));
  // Before the graph is checked against what the source gives, or every one of its inputs would be missing.
  if (sequence && sequence->source && !source_type(*sequence->source, registry_, diagnostics_)) return std::nullopt;
  return sequence;
}

std::optional<Graph> Commander::load(const GraphOptions& options, const Sequence* sequence, GraphInfo* info) {
  GraphRequest request;
  request.graph = options.graph;
  const auto edits = [&](Edit::Kind kind, const std::vector<std::string>& texts) {
    for (const auto& text : texts) request.edits.push_back({kind, text});
  };
  edits(Edit::Kind::swap, options.swap);
  edits(Edit::Kind::wire, options.wire);
  edits(Edit::Kind::set, options.set);
  edits(Edit::Kind::bypass, options.bypass);
  edits(Edit::Kind::tap, options.tap);
  return load(std::move(request), sequence, info);
}

std::optional<Graph> Commander::load(GraphRequest request, const Sequence* sequence, GraphInfo* info) {
  request.graphs = locations_.graphs;
  if (sequence) {
    request.roles = sequence->roles();
    if (sequence->source)
      for (const auto& port : registry_.find(sequence->source->type)->outputs())
        (*request.roles)[port.name] = port.type;
  }
  return load_graph(request, registry_, diagnostics_, info);
}

namespace {

// --source NAME=VALUE: as with --set, JSON when it is that, else text.
std::vector<JsonMember> source_parameters(const std::vector<std::string>& edits, Diagnostics& diagnostics) {
  std::vector<JsonMember> members;
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const auto equals = edits[i].find('=');
    if (equals == std::string::npos)
      throw Error(Exit::usage, fmt::format("--source {}: expected NAME=VALUE, as in --source width=1920", edits[i]));
    const auto name = edits[i].substr(0, equals), text = edits[i].substr(equals + 1);
    Diagnostics quiet;
    auto value = parse_json("", text, quiet).value_or(Json());
    if (!quiet.ok()) value.kind = Json::Kind::text, value.text = text;
    value.position = {diagnostics.sources.add(fmt::format("--source #{}", i + 1), edits[i]), 0};
    members.push_back({name, value.position, std::move(value)});
  }
  return members;
}

}  // namespace

std::unique_ptr<FrameSource> Commander::open(const Sequence& sequence, const SequenceOptions& options,
                                             const std::vector<std::string>& roles, int threads,
                                             const std::atomic<bool>* cancel) {
  if (!sequence.source) {
    if (!options.source.empty())
      throw Error(Exit::usage,
                  fmt::format("--source {}: this sequence is made of files and has no source node", options.source[0]));
    try {
      return open_sequence(sequence, roles, missing_from_name(options.missing).value(), diagnostics_);
    } catch (const MissingFrames& e) {
      if (!e.others()) throw;
      throw Error(e.exit(), fmt::format("{}\n  {}", e.what(),
                                        options.offers_missing ? "--missing skip, hold or black goes on without"
                                                               : "--frames picks others"));
    }
  }
  const auto parameters = source_parameters(options.source, diagnostics_);
  auto instance = source_instance(*sequence.source, {parameters, ""}, registry_, locations_.graphs, diagnostics_);
  if (!instance || !diagnostics_.ok()) return nullptr;
  return std::make_unique<NodeSource>(std::move(*instance), sequence.frames, sequence.cuts, threads, cancel);
}

Laboratory Commander::laboratory(std::filesystem::path references, int threads, const std::atomic<bool>* cancel) {
  return {registry_, diagnostics_, locations_.graphs, std::move(references), threads, cancel};
}

int Commander::report() {
  if (diagnostics_.ok())
    for (const auto& p : registry_.problems())
      diagnostics_.warning({}, p.file.string(), "passed over, for it cannot be used", {p.text});
  std::fputs(diagnostics_.format().c_str(), stderr);
  return int(diagnostics_.exit());
}

}  // namespace quell
