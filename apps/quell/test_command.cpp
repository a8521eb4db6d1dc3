// quell test: a suite of graphs on sequences, held to golden images and metrics, without anybody looking on.
#include "apps/quell/command.h"
#include "apps/quell/interrupt.h"
#include "apps/quell/options.h"

#include "core/lab/suite_run.h"
#include "core/report/suggest.h"
#include "core/sequence/temporary_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace quell {

namespace fs = std::filesystem;

namespace {

struct TestArguments {
  PluginOptions plugins;
  std::string suite, junit, failures, references;
  std::vector<std::string> only;
  bool update = false, quiet = false;
  int threads = 0;
  SimdOption simd;
};

// As a workflow command wants it: what would end it is encoded.
std::string encoded(const std::string& text, bool property) {
  std::string out;
  for (const char c : text) {
    const bool special = c == '%' || c == '\n' || c == '\r' || (property && (c == ':' || c == ','));
    out += special ? fmt::format("%{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
  }
  return out;
}

// In GitHub Actions a failure is shown beside the line of the suite that it belongs to.
void annotate(const Diagnostics& diagnostics, const SuiteTest& test, const std::string& text) {
  const char* actions = std::getenv("GITHUB_ACTIONS");
  if (!actions || std::string_view(actions) != "true") return;
  const auto place = diagnostics.sources.place_parts(test.position);
  fmt::print("::error file={},line={},title={}::{}\n", encoded(place.name, true), place.line, encoded(test.name, true),
             encoded(text, false));
}

void print(const TestOutcome& o) {
  fmt::print("{} {} ({:.2f} s)\n", o.good() ? "passed" : "FAILED", o.name, o.seconds);
  for (const auto& f : o.failures) fmt::print("  {}\n", f);
  if (!o.error.empty()) fmt::print("  error: {}\n", o.error);
  std::fflush(stdout);
}

std::vector<std::size_t> chosen(const Suite& suite, const std::vector<std::string>& only) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < suite.tests.size(); ++i)
    if (only.empty() || std::ranges::any_of(only, [&](const auto& o) { return suite.tests[i].name.find(o) != o.npos; }))
      all.push_back(i);
  if (!all.empty()) return all;
  std::vector<std::string> names;
  for (const auto& t : suite.tests) names.push_back(t.name);
  throw Error(Exit::usage, fmt::format("--only {}: no test is called so\n  {}", only[0],
                                       possibilities("there are", only[0], names)));
}

int run(const TestArguments& a) {
  const auto& cancel = watch_interrupts();
  a.simd.apply();
  Commander commander(a.plugins);
  auto& diagnostics = commander.diagnostics();
  const auto suite = load_suite(a.suite, commander.locations().graphs, diagnostics);
  if (!suite) return commander.report();
  if (!a.junit.empty()) check_writable(a.junit);
  Laboratory lab{commander.registry(), diagnostics, commander.locations().graphs, a.references, a.threads, &cancel};
  // All are read before the first is run: a mistake in the last would else be found when the others have taken their
  // time.
  const auto tests = chosen(*suite, a.only);
  std::vector<std::optional<Trial>> trials;
  for (const auto i : tests) {
    const auto& study = suite->tests[i].study;
    trials.push_back(Trial::load(study, study.sequences.front(), false, lab));
  }
  if (const int code = commander.report()) return code;

  SuiteRunOptions options;
  options.run.threads = a.threads;
  options.run.cancel = &cancel;
  options.update_golden = a.update;
  options.failures = a.failures;
  options.command = command_line();
  options.simd = simd_in_use();
  std::vector<TestOutcome> outcomes;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const auto& test = suite->tests[tests[i]];
    const auto& o = outcomes.emplace_back(run_test(test, *trials[i], lab, options));
    if (!a.quiet || !o.good()) print(o);
    for (const auto& f : o.failures) annotate(diagnostics, test, f);
    if (!o.error.empty()) annotate(diagnostics, test, o.error);
  }
  if (!a.junit.empty()) write_file(a.junit, junit_xml(suite->name, outcomes));
  const auto good = std::ranges::count_if(outcomes, &TestOutcome::good);
  fmt::print("{} passed, {} failed\n", good, std::ssize(outcomes) - good);
  return good == std::ssize(outcomes) ? 0 : int(Exit::threshold);
}

}  // namespace

void add_test(CLI::App& app, int& exit) {
  auto* sub = app.add_subcommand("test", "Runs a suite: graphs held to golden images and to conditions on metrics.");
  auto a = std::make_shared<TestArguments>();
  sub->add_option("suite", a->suite, "A suite file.")->required()->type_name("SUITE");
  sub->add_option("--only", a->only, "Runs the tests whose names hold this; may be given more than once.")
      ->type_name("TEXT")
      ->take_all()
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  sub->add_flag("--update-golden", a->update, "Writes the golden images anew, to be looked at before they are kept.");
  sub->add_option("--junit", a->junit, "Writes the outcomes as JUnit's XML.")->type_name("FILE");
  sub->add_option("--failures", a->failures, "Where pictures go that fail, beside their golden ones.")
      ->type_name("DIR");
  sub->add_option("--references", a->references, "Folder where references are kept that a source node makes.")
      ->type_name("DIR");
  sub->add_option("--threads", a->threads, "Threads; 0: every core that affinity and quotas grant.")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  a->simd.add_to(*sub);
  sub->add_flag("-q,--quiet", a->quiet, "Prints failures and the closing line only.");
  a->plugins.add_to(*sub);
  sub->footer(
      "Ends with exit code 1 when a test fails. In GitHub Actions failures are shown beside their lines.\n"
      "Examples:\n"
      "  quell test suite.json --junit out.xml --failures failures\n"
      "  quell test suite.json --only svgf --update-golden");
  sub->callback([a, &exit] { exit = run(*a); });
}

}  // namespace quell
