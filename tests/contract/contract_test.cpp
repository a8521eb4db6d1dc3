// What every node keeps, whatever it does: checked on each plugin found, from its table alone.
#include "tests/contract/checks.h"
#include "tests/contract/use.h"
#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

#include <quell/types.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace quell::test {

namespace {

struct Size {
  int width, height;
};
constexpr Size kSmall{17, 3}, kLarge{67, 41};

const std::vector<const NodeType*>& weight_nodes() {
  static const std::vector<const NodeType*> list = [] {
    std::vector<const NodeType*> found;
    for (const auto* type : registry().all())
      if (type->is_weight()) found.push_back(type);
    return found;
  }();
  return list;
}

std::vector<std::string> weight_names() {
  std::vector<std::string> names;
  for (const auto* type : weight_nodes()) names.emplace_back(type->name());
  return names;
}

bool has_input(const NodeType& type, int port_type) {
  return std::ranges::any_of(type.inputs(), [&](const auto& p) { return p.type == port_type; });
}
bool needs_file(const NodeType& type) {
  return std::ranges::any_of(type.params(), [](const auto& p) { return p.kind == QUELL_PATH; });
}
bool takes_images(const NodeType& type) {
  return std::ranges::any_of(type.inputs(), [](const auto& p) { return p.type == QUELL_ANY || is_pixels(p.type); });
}

// A node without images makes its own size: a small one, where it has parameters of these names.
void shrink(Use& use) {
  if (takes_images(*use.type)) return;
  for (const auto& [name, value] : {std::pair{"width", 48}, std::pair{"height", 32}})
    if (const int i = use.type->find_param(name); i >= 0 && use.type->params()[std::size_t(i)].kind == QUELL_INT)
      use.instance.set_int(i, value);
}

// The ways of wiring a node that its table allows, at one size.
std::vector<Choices> wirings(const NodeType& type, Size size) {
  Choices all;
  all.width = size.width, all.height = size.height;
  all.weights = weight_nodes();
  std::vector<Choices> list{all};
  Choices bare = all;
  bare.optional = false, bare.listed = 1;
  if (!bare.weights.empty()) bare.weights.resize(1);
  list.push_back(bare);
  for (std::size_t i = 0; i < type.inputs().size(); ++i)
    if (type.inputs()[i].flags & QUELL_OPTIONAL) {
      list.push_back(all);
      list.back().only = int(i);
    }
  if (has_input(type, QUELL_WEIGHT))
    for (const auto* weight : all.weights) {
      list.push_back(all);
      list.back().weights = {weight};
    }
  if (has_input(type, QUELL_ANY))
    for (const int other : {QUELL_DEPTH, QUELL_FEATURES}) {
      list.push_back(all);
      list.back().any = other;
    }
  return list;
}

class Contract : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    type_ = registry().find(GetParam());
    const auto* problem = registry().problem(GetParam());
    ASSERT_NE(type_, nullptr) << (problem ? problem->text : "no such plugin");
  }
  const NodeType& type() const { return *type_; }

  // Applies `check` to the node in each wiring at this size. A node may refuse a wiring, in words, but not all of them,
  // unless what it wants is a file.
  template <class F>
  void in_each_wiring(Size size, F&& check) {
    int number = 0, ran = 0;
    std::string refusals;
    for (const auto& choices : wirings(type(), size)) {
      SCOPED_TRACE(testing::Message() << size.width << "x" << size.height << ", wiring " << number++);
      Use use(type(), choices);
      shrink(use);
      try {
        EXPECT_EQ(check(use), "");
        ++ran;
      } catch (const std::runtime_error& e) {
        EXPECT_STRNE(e.what(), "");
        refusals += std::string(e.what()) + "; ";
      }
    }
    EXPECT_TRUE(ran > 0 || needs_file(type())) << "refuses every wiring: " << refusals;
  }

 private:
  const NodeType* type_ = nullptr;
};

bool is_sentence(std::string_view text) { return text.size() > 5 && text.back() == '.'; }

bool is_number(const quell_param& p) { return p.kind == QUELL_INT || p.kind == QUELL_FLOAT || p.kind == QUELL_FLOATS; }
// What numbers are counted in, be it a share or a multiple.
bool names_its_unit(const char* doc) {
  std::string text(doc);
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  constexpr std::string_view kUnits[] = {"pixel",        "frames",      "sample",         "channel",
                                         "times",        "multiplies",  "share",          "cosine",
                                         "radians",      "stops",       "unit of",        "units of",
                                         "unit or",      "same unit",   "image's unit",   "albedo",
                                         "radiance",     "scene units", "standard error", "standard deviation",
                                         "distances of", "factor",      "pure number"};
  return std::ranges::any_of(kUnits, [&](auto unit) { return text.find(unit) != text.npos; });
}

TEST_P(Contract, IsDocumented) {
  EXPECT_EQ(type().name(), GetParam()) << "a library is called after its node";
  EXPECT_PRED1(is_sentence, type().table().summary);
  for (const auto& p : type().inputs()) EXPECT_PRED1(is_sentence, p.doc) << "input " << p.name;
  for (const auto& p : type().outputs()) EXPECT_PRED1(is_sentence, p.doc) << "output " << p.name;
  for (const auto& p : type().params()) {
    EXPECT_PRED1(is_sentence, p.doc) << "parameter " << p.name;
    if (is_number(p)) {
      EXPECT_PRED1(names_its_unit, p.doc) << "parameter " << p.name;
    }
  }
}

TEST_P(Contract, BoundsItsParameters) {
  for (const auto& p : type().params()) {
    if (p.kind != QUELL_INT && p.kind != QUELL_FLOAT && p.kind != QUELL_FLOATS) continue;
    EXPECT_FALSE(std::isnan(p.min) || std::isnan(p.max)) << p.name;
    if (p.kind != QUELL_INT) continue;
    EXPECT_TRUE(!std::isfinite(p.min) || p.min == std::floor(p.min)) << p.name;
    EXPECT_TRUE(!std::isfinite(p.max) || p.max == std::floor(p.max)) << p.name;
  }
}

TEST_P(Contract, CanBeBypassedAsItSays) {
  for (const auto& out : type().outputs()) {
    if (out.passes >= 0) {
      const auto& in = type().inputs()[std::size_t(out.passes)];
      EXPECT_FALSE(in.flags & QUELL_LIST) << out.name << " passes the list " << in.name;
    }
    if (out.with >= 0) {
      const auto& in = type().inputs()[std::size_t(out.with)];
      EXPECT_TRUE(in.flags & QUELL_OPTIONAL) << out.name << " is with " << in.name << ", which is always there";
    }
  }
}

TEST_P(Contract, DeclaresItsReach) {
  const Instance instance(type());
  for (const auto& r : instance.reach()) {
    EXPECT_GE(std::min({r.left, r.right, r.up, r.down, r.step}), 0);
    EXPECT_TRUE(r.anywhere == 0 || r.anywhere == 1);
    EXPECT_LE(std::max(r.left, r.right), QUELL_MARGIN) << "columns beyond the margin cannot be read";
  }
}

TEST_P(Contract, RunsAtEverySize) {
  for_each_target([&] {
    for (const Size size : {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{2, 2}, kSmall, Size{16, 5}, kLarge})
      in_each_wiring(size, [](const Use& use) { return use.type->is_weight() ? "" : breaks_when_run(use); });
  });
}

TEST_P(Contract, RunsWithoutAPast) {
  for (const Size size : {Size{1, 1}, kLarge}) {
    Choices choices;
    choices.width = size.width, choices.height = size.height;
    choices.missing = true;
    choices.weights = weight_nodes();
    Use use(type(), choices);
    shrink(use);
    if (type().is_weight()) continue;
    try {
      EXPECT_EQ(breaks_when_run(use), "");
    } catch (const std::runtime_error& e) {
      EXPECT_TRUE(needs_file(type())) << e.what();
    }
  }
}

TEST_P(Contract, GivesTheSameBitsInAnyTiles) {
  struct Tiles {
    int rows, columns;
  };
  for_each_target([&] {
    for (const Tiles t : {Tiles{1, 0}, Tiles{7, 0}, Tiles{64, 0}, Tiles{0, 0}, Tiles{16, 32}, Tiles{5, 23}})
      in_each_wiring(kLarge, [&](const Use& use) {
        const auto text = use.type->is_weight() ? "" : breaks_in_tiles(use, t.rows, t.columns);
        return text.empty() ? text
                            : "tiles of " + std::to_string(t.rows) + "x" + std::to_string(t.columns) + ": " + text;
      });
  });
}

TEST_P(Contract, GivesTheSameBitsOnAnyThreads) {
  in_each_wiring(kLarge, [](const Use& use) { return use.type->is_weight() ? "" : breaks_in_threads(use, 4); });
}

TEST_P(Contract, KeepsNonFiniteNumbersWithinItsReach) {
  in_each_wiring(kLarge, [](const Use& use) { return use.type->is_weight() ? "" : breaks_on_non_finite(use); });
}

class WeightContract : public Contract {};

TEST_P(WeightContract, WeighsRuns) {
  for_each_target([&] {
    for (const Size size : {Size{1, 1}, Size{1, 9}, kSmall, Size{200, 6}})
      in_each_wiring(size, [](const Use& use) { return breaks_when_weighing(use); });
  });
}

// A number at the end of its range may contradict another parameter: then the node says so.
TEST_P(Contract, RunsAtTheEndsOfItsRanges) {
  constexpr std::int64_t kMostPixels = 1 << 22;
  for (std::size_t i = 0; i < type().params().size(); ++i) {
    const auto& p = type().params()[i];
    for (const double end : {p.min, p.max}) {
      if (!std::isfinite(end) || p.kind == QUELL_TEXT || p.kind == QUELL_PATH) continue;
      SCOPED_TRACE(testing::Message() << p.name << " = " << end);
      Choices choices;
      choices.width = kSmall.width, choices.height = kSmall.height;
      choices.weights = weight_nodes();
      Use use(type(), choices);
      shrink(use);
      switch (p.kind) {
        case QUELL_BOOL:
          use.instance.set_bool(int(i), end != 0);
          break;
        case QUELL_INT:
        case QUELL_CHOICE:
          use.instance.set_int(int(i), int(end));
          break;
        case QUELL_FLOAT:
          use.instance.set_float(int(i), float(end));
          break;
        default:
          use.instance.set_floats(int(i), std::vector<float>(std::size_t(p.count), float(end)));
      }
      try {
        if (type().is_weight()) {
          EXPECT_EQ(breaks_when_weighing(use), "");
          continue;
        }
        const auto extent = Bound(use).extent();
        if (std::int64_t(extent.width) * extent.height > kMostPixels) continue;
        EXPECT_EQ(breaks_when_run(use), "");
      } catch (const std::runtime_error& e) {
        EXPECT_STRNE(e.what(), "");
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryPlugin, Contract, testing::ValuesIn(registry().names()),
                         [](const auto& test) { return test.param; });
INSTANTIATE_TEST_SUITE_P(EveryPlugin, WeightContract, testing::ValuesIn(weight_names()),
                         [](const auto& test) { return test.param; });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Contract);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(WeightContract);

}  // namespace

}  // namespace quell::test
