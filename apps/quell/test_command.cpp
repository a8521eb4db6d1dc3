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

// What a run tells people and CI systems.
class Printer {
 public:
  // stdout is left to what --junit writes there.
  Printer(const Sources& sources, bool junit) : sources_(sources), out_(junit ? stderr : stdout) {}

  // In GitHub Actions what is wrong is shown beside the line of the suite that it belongs to.
  void annotate(TextPosition position, const std::string& title, const std::string& text) const {
    const char* actions = std::getenv("GITHUB_ACTIONS");
    if (!actions || std::string_view(actions) != "true") return;
    const auto place = sources_.place_parts(position);
    fmt::print(out_, "::error file={},line={},title={}::{}\n", encoded(place.name, true), place.line,
               encoded(title, true), encoded(text, false));
  }

  void print(const TestOutcome& o) const {
    const char* word = !o.good() ? "FAILED" : o.written.empty() ? "passed" : "written";
    fmt::print(out_, "{} {} ({:.2f} s)\n", word, o.name, o.seconds);
    for (const auto& w : o.written) fmt::print(out_, "  {}\n", w);
    for (const auto& f : o.failures) fmt::print(out_, "  {}\n", f);
    if (!o.error.empty()) fmt::print(out_, "  error: {}\n", o.error);
    std::fflush(out_);
  }

  // Golden images that were only just written have been held to nothing.
  void sum_up(const std::vector<TestOutcome>& outcomes) const {
    const auto failed = std::ranges::count_if(outcomes, [](const TestOutcome& o) { return !o.good(); });
    const auto written =
        std::ranges::count_if(outcomes, [](const TestOutcome& o) { return o.good() && !o.written.empty(); });
    fmt::print(out_, "{} passed, {} failed{}\n", std::ssize(outcomes) - failed - written, failed,
               written ? fmt::format(", {} written", written) : "");
  }

 private:
  const Sources& sources_;
  std::FILE* out_;
};

void write_junit(const std::string& path, const std::string& name, const std::vector<TestOutcome>& outcomes) {
  const auto text = junit_xml(name, outcomes);
  if (path == "-")
    std::fputs(text.c_str(), stdout);
  else if (!path.empty())
    write_file(path, text);
}

// A suite that is wrong itself: one outcome, which says how.
int refuse(const TestArguments& a, Commander& commander, const Printer& printer) {
  auto& diagnostics = commander.diagnostics();
  for (const auto* d : diagnostics.in_order())
    if (d->severity == Severity::error) printer.annotate(d->position, "suite", d->text);
  write_junit(a.junit, a.suite, {TestOutcome{.name = a.suite, .error = diagnostics.format()}});
  return commander.report();
}

std::vector<std::size_t> chosen(const Suite& suite, const std::vector<std::string>& only) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < suite.tests.size(); ++i)
    if (only.empty() || std::ranges::any_of(only, [&](const auto& o) { return suite.tests[i].name.find(o) != o.npos; }))
      all.push_back(i);
  if (!all.empty()) return all;
  throw Error(Exit::usage, fmt::format("--only {}: no test is called so\n  {}", only[0],
                                       possibilities("there are", only[0], names_of(suite.tests))));
}

int run(const TestArguments& a) {
  const auto& cancel = watch_interrupts();
  a.simd.apply();
  Commander commander(a.plugins);
  auto& diagnostics = commander.diagnostics();
  const auto suite = load_suite(a.suite, commander.locations().graphs, diagnostics);
  const Printer printer(diagnostics.sources, a.junit == "-");
  if (!a.junit.empty() && a.junit != "-") check_writable(a.junit);
  if (!suite) return refuse(a, commander, printer);
  auto lab = commander.laboratory(a.references, a.threads, &cancel);
  // All are read before the first is run: a mistake in the last would else be found when the others have taken their
  // time.
  const auto tests = chosen(*suite, a.only);
  std::vector<std::optional<Trial>> trials;
  for (const auto i : tests) {
    const auto& study = suite->tests[i].study;
    trials.push_back(Trial::load(study, study.sequences.front(), false, lab));
  }
  if (!diagnostics.ok()) return refuse(a, commander, printer);
  commander.report();

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
    if (!a.quiet || !o.good()) printer.print(o);
    for (const auto& f : o.failures) printer.annotate(test.position, test.name, f);
    if (!o.error.empty()) printer.annotate(test.position, test.name, o.error);
  }
  write_junit(a.junit, suite->name, outcomes);
  printer.sum_up(outcomes);
  return std::ranges::all_of(outcomes, &TestOutcome::good) ? 0 : int(Exit::threshold);
}

}  // namespace

void add_test(CLI::App& app, int& exit) {
  auto* sub = app.add_subcommand("test", "Runs a suite: graphs held to golden images and to conditions on metrics.");
  auto a = std::make_shared<TestArguments>();
  sub->add_option("suite", a->suite, "A suite file.")->required()->type_name("SUITE");
  repeatable(sub->add_option("--only", a->only, "Runs the tests whose names hold this; may be given more than once."))
      ->type_name("TEXT");
  sub->add_flag("--update-golden", a->update, "Writes the golden images anew, to be looked at before they are kept.");
  sub->add_option("--junit", a->junit, "Writes the outcomes as JUnit's XML; - is stdout.")
      ->type_name("FILE")
      ->check(not_empty());
  sub->add_option("--failures", a->failures, "Where pictures go that fail, beside their golden ones.")
      ->type_name("DIR")
      ->check(not_empty());
  sub->add_option("--references", a->references, "Folder where references are kept that a source node makes.")
      ->type_name("DIR")
      ->check(not_empty());
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
