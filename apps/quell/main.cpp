// The quell command: one subcommand a file.
#include "apps/quell/command.h"
#include "apps/quell/interrupt.h"

#include "core/report/suggest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <vector>

namespace {

// `quell help run` is `quell run --help`.
std::vector<std::string> with_help_as_option(std::vector<std::string> args) {
  if (args.empty() || args[0] != "help") return args;
  args.erase(args.begin());
  args.resize(std::min<std::size_t>(args.size(), 1));
  args.emplace_back("--help");
  return args;
}

// "usage: quell run GRAPH SEQUENCE [OPTION…]".
std::string usage(const CLI::App& at, const std::string& name) {
  std::string out = "usage: " + name;
  if (!at.get_subcommands({}).empty()) out += " SUBCOMMAND";
  for (const auto* option : at.get_options()) {
    if (!option->get_positional()) continue;
    const auto shown = option->get_type_name();
    out += option->get_required() ? " " + shown : " [" + shown + "]";
  }
  return out + " [OPTION…]";
}

std::string problem_text(const CLI::App& at, const CLI::ParseError& error) {
  if (dynamic_cast<const CLI::RequiredError*>(&error)) {
    std::vector<std::string> missing;
    for (const auto* option : at.get_options())
      if (option->get_required() && option->count() == 0) missing.push_back(option->get_type_name());
    if (!missing.empty()) return fmt::format("{} missing", fmt::join(missing, " and "));
  }
  const auto extra = at.remaining();
  if (!dynamic_cast<const CLI::ExtrasError*>(&error) || extra.empty()) return error.what();
  const auto stray = extra[0].substr(0, extra[0].find('='));
  if (!stray.starts_with("-")) return fmt::format("'{}' is one argument too many", extra[0]);
  std::vector<std::string> options;
  for (const auto* option : at.get_options())
    for (const auto& name : option->get_lnames()) options.push_back("--" + name);
  const auto near = quell::nearest(stray, options);
  return fmt::format("there is no option '{}'{}", stray, near.empty() ? "" : fmt::format(". Did you mean '{}'?", near));
}

int run(int argc, char** argv) {
  CLI::App app("Denoises path-traced image sequences with graphs of plugin nodes.", "quell");
  app.set_version_flag("--version", "quell " QUELL_VERSION);
  app.require_subcommand(1);
  // So that a script's options can be overridden behind them.
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.footer(
      "Examples:\n"
      "  quell run svgf room -o 'out/color.####.exr' --preview\n"
      "  quell check my_graph.json\n"
      "`quell SUBCOMMAND --help` has more.\n\n"
      "Exit codes: 0 good, 1 a threshold or comparison failed, 2 usage or graph error, 3 input missing or corrupt,\n"
      "4 plugin, 5 resources, 130 interrupted (143: by SIGTERM).\n"
      "Environment: QUELL_PLUGINS, folders of plugins with colons between; QUELL_GRAPHS, the folder of installed "
      "graphs.");
  int exit = 0;
  quell::add_run(app, exit);
  quell::add_rerun(app, exit);
  quell::add_check(app, exit);
  quell::add_nodes(app, exit);
  quell::add_metrics(app, exit);
  quell::add_graph(app, exit);
  quell::add_plan(app, exit);
  quell::add_bench(app, exit);
  quell::add_ablate(app, exit);
  quell::add_compare(app, exit);
  quell::add_test(app, exit);
  quell::add_tune(app, exit);

  const auto args = with_help_as_option({argv + 1, argv + argc});
  std::vector<std::string> commands;
  for (const auto* sub : app.get_subcommands({})) commands.push_back(sub->get_name());
  if (!args.empty() && !args[0].starts_with("-") && std::ranges::find(commands, args[0]) == commands.end()) {
    fmt::print(stderr, "quell: error: there is no subcommand '{}'\n  {}\n", args[0],
               quell::possibilities("there are", args[0], commands));
    return int(quell::Exit::usage);
  }
  try {
    app.parse(std::vector<std::string>(args.rbegin(), args.rend()));
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    const auto given = app.get_subcommands();
    const CLI::App& at = given.empty() ? app : *given[0];
    const std::string name = given.empty() ? "quell" : "quell " + at.get_name();
    fmt::print(stderr, "{}: error: {}\n  {}; `{} --help` tells more\n", name, problem_text(at, e), usage(at, name),
               name);
    return int(quell::Exit::usage);
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout))
    throw quell::Error(quell::Exit::resources,
                       fmt::format("cannot write to the standard output: {}", std::strerror(errno)));
  return exit;
}

}  // namespace

int main(int argc, char** argv) {
  // A limit on the size of files is an error to report like a full disk, not a reason to die.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return run(argc, argv);
  } catch (const quell::Error& e) {
    fmt::print(stderr, "quell: {}{}\n", e.exit() == quell::Exit::interrupted ? "" : "error: ", e.what());
    return e.exit() == quell::Exit::interrupted ? quell::interrupted_exit() : int(e.exit());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "quell: error: out of memory; use smaller frames or --max-memory\n");
    return int(quell::Exit::resources);
  } catch (const std::exception& e) {
    fmt::print(stderr, "quell: error: {}\n", e.what());
    return int(quell::Exit::resources);
  }
}
