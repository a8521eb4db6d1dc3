// The quell command: one subcommand a file.
#include "apps/quell/command.h"

#include "core/report/suggest.h"
#include "core/sequence/temporary_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <new>

namespace {

int run(int argc, char** argv) {
  CLI::App app("Denoises path-traced image sequences with graphs of plugin nodes.", "quell");
  app.set_version_flag("--version", "quell " QUELL_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 good, 1 a threshold or comparison failed, 2 usage or graph error, 3 input missing or corrupt, 4 "
      "plugin, 5 resources.\n"
      "`quell SUBCOMMAND --help` has examples.");
  int exit = 0;
  quell::add_run(app, exit);
  quell::add_check(app, exit);
  quell::add_nodes(app, exit);
  quell::add_graph(app, exit);
  quell::add_plan(app, exit);

  std::vector<std::string> commands;
  for (const auto* sub : app.get_subcommands([](const CLI::App*) { return true; })) commands.push_back(sub->get_name());
  if (argc > 1 && argv[1][0] != '-' && std::ranges::find(commands, std::string(argv[1])) == commands.end()) {
    fmt::print(stderr, "quell: error: there is no subcommand '{}'\n  {}\n", argv[1],
               quell::possibilities("there are", argv[1], commands));
    return 2;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    fmt::print(stderr, "quell: error: {}\n  `quell --help` and `quell SUBCOMMAND --help` tell more.\n", e.what());
    return 2;
  }
  return exit;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const quell::Error& e) {
    fmt::print(stderr, "quell: {}{}\n", e.exit() == quell::Exit::interrupted ? "" : "error: ", e.what());
    quell::remove_temporaries();
    return int(e.exit());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "quell: error: out of memory; use smaller frames or --max-memory\n");
    return int(quell::Exit::resources);
  } catch (const std::exception& e) {
    fmt::print(stderr, "quell: error: {}\n", e.what());
    return int(quell::Exit::resources);
  }
}
