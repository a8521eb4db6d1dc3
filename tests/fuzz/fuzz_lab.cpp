// Any bytes are a study, a suite or a tuning, or give errors that can be shown. What is one can be written out: its
// variants have names and edits that are text and, laid over the graph, give a graph or errors; a search stays within
// its ranges.
//
// Node types are those of the folder QUELL_TEST_PLUGINS, where there are some. Nothing runs.
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/registry.h"

#include "core/graph/load.h"
#include "core/lab/edits.h"
#include "core/lab/search.h"
#include "core/lab/suite.h"
#include "core/lab/tuning.h"

#include <cmath>
#include <cstdlib>
#include <set>

namespace {

const std::string kGraphs = QUELL_FUZZ_GRAPHS;
constexpr std::size_t kTried = 4;  // variants of a study whose graphs are loaded, and steps of a search

void require(bool truth) {
  if (!truth) std::abort();
}

template <class T>
void require_words(const std::optional<T>& loaded, const quell::Diagnostics& diagnostics) {
  require(loaded.has_value() == diagnostics.ok());
  require(loaded || !diagnostics.format().empty());
}

// Only graphs that are installed, for any other file may be endless.
void load(const quell::StudyVariant& variant) {
  static const auto installed = [] {
    const auto names = quell::installed_graphs(kGraphs);
    return std::set<std::string>(names.begin(), names.end());
  }();
  if (!installed.count(variant.graph)) return;
  quell::GraphRequest request;
  request.graph = variant.graph;
  request.graphs = kGraphs;
  request.laid_over = variant.edits;
  quell::Diagnostics diagnostics;
  require_words(quell::load_graph(request, quell::fuzz::registry(), diagnostics), diagnostics);
}

void write_out(const quell::Study& study) {
  require(!study.sequences.empty() && !study.variants.empty() && study.variants.size() <= quell::kMaxVariants);
  std::set<std::string> names;
  std::size_t tried = 0;
  for (const auto& variant : study.variants) {
    require(names.insert(variant.name).second);
    require(!quell::edits_text(variant.edits).empty());
    require(!quell::run_command(study, variant).empty());
    if (tried++ < kTried) load(variant);
  }
}

void write_out(const quell::Suite& suite) {
  require(!suite.tests.empty());
  for (const auto& test : suite.tests) {
    write_out(test.study);
    require(test.golden || !test.fail.empty());
    for (const auto& condition : test.fail) require(std::isfinite(condition.limit));
  }
}

void write_out(const quell::Tuning& tuning) {
  write_out(tuning.training);
  if (tuning.held_out) write_out(*tuning.held_out);
  require(!tuning.minimise->names().empty());
  std::vector<quell::SearchRange> ranges;
  for (const auto& parameter : tuning.parameters) ranges.push_back(parameter.range);
  const auto found = quell::search(ranges, kTried, tuning.tolerance, [&](auto point) {
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      require(point[i] >= ranges[i].from && point[i] <= ranges[i].to);
      require(!ranges[i].integer || point[i] == std::round(point[i]));
    }
    return point[0];
  });
  require(found.evaluations > 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = quell::fuzz::input_file(data, size);
  const auto each = [&](auto load_file) {
    quell::Diagnostics diagnostics;
    const auto loaded = load_file(diagnostics);
    require_words(loaded, diagnostics);
    if (loaded) write_out(*loaded);
  };
  each([&](auto& diagnostics) { return quell::load_study({file, kGraphs}, diagnostics); });
  each([&](auto& diagnostics) { return quell::load_suite(file, kGraphs, diagnostics); });
  each([&](auto& diagnostics) { return quell::load_tuning(file, kGraphs, diagnostics); });
  return 0;
}
