// The built-in sequences: each runs, shows something, and changes where its comment says that it does.
#include "tests/support/paths.h"
#include "tests/support/run_sequence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <set>

namespace quell::test {
namespace {

const std::filesystem::path kSequences = QUELL_TEST_SOURCE "/graphs/sequences";

SequenceResult run(const std::string& graph, const std::string& sequence, const std::string& frames) {
  return run_sequence({.graph = graph,
                       .sequence = (kSequences / (sequence + ".json")).string(),
                       .frames = frames,
                       .source_ints = {{"width", 96}, {"height", 54}}});
}

bool same(const Image& a, const Image& b) {
  for (int c = 0; c < a.channels(); ++c)
    for (int y = 0; y < a.height(); ++y)
      if (std::memcmp(a.row(c, y), b.row(c, y), std::size_t(a.width()) * sizeof(float)) != 0) return false;
  return true;
}

double mean(const Image& image) {
  double sum = 0;
  for (int c = 0; c < image.channels(); ++c)
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) sum += double(image.at(c, x, y));
  return sum / (image.channels() * image.width() * image.height());
}

TEST(BuiltInSequences, RunAndShowSomething) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kSequences)) names.insert(entry.path().stem().string());
  EXPECT_TRUE(names.contains("room") && names.contains("hall") && names.contains("yard"));
  for (const auto& name : names) {
    SCOPED_TRACE(name);
    const auto result = run("recommended", name, "0-1");
    ASSERT_EQ(result.images.size(), 2u);
    for (const auto& [frame, images] : result.images) {
      for (int c = 0; c < 3; ++c)
        for (int y = 0; y < 54; ++y)
          for (int x = 0; x < 96; ++x) ASSERT_TRUE(std::isfinite(images[0].at(c, x, y)));
      EXPECT_GT(mean(images[0]), 0.03);
    }
  }
}

// The yard's cut, declared, starts anew; undeclared, the gate of temporal_accumulation finds it, in the very frame and
// in no other.
TEST(BuiltInSequences, TheYardsCutIsFoundWhereItIs) {
  const auto raw = run("unfiltered", "yard", "6-9"), declared = run("temporal_accumulation", "yard", "6-9"),
             found = run("temporal_accumulation", "yard_undeclared", "6-9");
  EXPECT_EQ(declared.report.resets, 2u);
  EXPECT_EQ(found.report.resets, 1u) << "of the first frame alone";
  for (const int frame : {7, 9}) EXPECT_FALSE(same(found.images.at(frame)[0], raw.images.at(frame)[0])) << frame;
  for (const auto* r : {&declared, &found}) EXPECT_TRUE(same(r->images.at(8)[0], raw.images.at(8)[0]));
}

}  // namespace
}  // namespace quell::test
