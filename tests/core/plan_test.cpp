// Shapes that a plan settles, and those that it refuses before a kernel could trust them.
#include "core/run/plan.h"

#include "core/plugin/registry.h"
#include "core/report/error.h"
#include "core/run/executor.h"
#include "tests/support/add_type.h"

#include <gtest/gtest.h>
#include <quell/node.h>

namespace quell::test {
namespace {

struct Blend {
  In<Any> a, b;
  Out<Any> out;
  void describe(Describe& d) {
    d.summary("Blends.");
    d.in(a, "a", "A.");
    d.in(b, "b", "B.").optional();
    d.out(out, "out", "Of A and B.");
  }
  void run(const Tile&) const {}
};

struct Tint {
  In<Radiance> image;
  Out<Radiance> out;
  void describe(Describe& d) {
    d.summary("Tints.");
    d.in(image, "image", "An image.");
    d.out(out, "out", "Tinted.");
  }
  void run(const Tile&) const {}
};

struct Half {
  In<Any> image;
  Out<Any> out;
  void describe(Describe& d) {
    d.summary("Halves the size.");
    d.in(image, "image", "An image.").anywhere();
    d.out(out, "out", "Half as large.");
  }
  void shapes(const quell_spec& spec, quell_shape* shape) const {
    shape[0].width = (spec.in[0].width + 1) / 2;
    shape[0].height = (spec.in[0].height + 1) / 2;
  }
  void run(const Tile&) const {}
};

struct Sorts {
  In<Features> image;
  In<Scalar> by;
  Out<Features> out;
  void describe(Describe& d) {
    d.summary("Sorts channels.");
    d.in(image, "image", "An image.");
    d.in(by, "by", "What it is sorted by.");
    d.out(out, "out", "As many channels.");
  }
  void shapes(const quell_spec& spec, quell_shape*) const {
    if (spec.in[0].channels < 2) throw std::runtime_error("there is nothing to sort");
  }
  void run(const Tile&) const {}
};

struct Likeness {
  In<Scalar> image;
  Out<Weight> weight;
  void describe(Describe& d) {
    d.summary("Weighs.");
    d.in(image, "image", "An image.");
    d.out(weight, "weight", "Of the image.");
  }
  void weigh(const quell_input*, const quell_run&, float*) const {}
};

struct Filter {
  In<Scalar> image;
  InList<Weight> weights;
  Out<Scalar> out;
  void describe(Describe& d) {
    d.summary("Filters.");
    d.in(image, "image", "An image.");
    d.in(weights, "weights", "Weights.");
    d.out(out, "out", "Filtered.");
  }
  void run(const Tile&) const {}
};

struct Join {
  InList<Any> images;
  Out<Features> out;
  void describe(Describe& d) {
    d.summary("Joins.");
    d.in(images, "images", "Images.");
    d.out(out, "out", "All channels.");
  }
  void shapes(const quell_spec& spec, quell_shape* shape) const { shape[0].channels = spec.in_channels[0]; }
  void run(const Tile&) const {}
};

// The sum of a corner, and what exists only with a second image.
struct Measure {
  In<Scalar> a, b;
  Out<Scalar> difference;
  Out<Value> corner;
  void describe(Describe& d) {
    d.summary("Measures.");
    d.in(a, "a", "A.");
    d.in(b, "b", "B.").optional();
    d.out(difference, "difference", "Of A and B.").with(b);
    d.out(corner, "corner", "Of A.");
  }
  void run(const Tile& t) const { t.row(corner, 0, 0)[0] = t.row(a, 0, 0)[0] + 1; }
};

Registry& nodes() {
  static Registry registry({});
  static const bool added = add_type<Blend>(registry, "blend") && add_type<Tint>(registry, "tint") &&
                            add_type<Half>(registry, "half") && add_type<Sorts>(registry, "sorts") &&
                            add_type<Likeness>(registry, "likeness") && add_type<Filter>(registry, "filter") &&
                            add_type<Measure>(registry, "measure") && add_type<Join>(registry, "join");
  EXPECT_TRUE(added);
  return registry;
}

GraphNode make(const char* name, const char* type, std::vector<std::vector<Wire>> in, int any = QUELL_SCALAR) {
  const auto* t = nodes().find(type);
  std::vector<int> types;
  for (const auto& o : t->outputs()) types.push_back(o.type == QUELL_ANY ? any : o.type);
  return {name, Instance(*t), std::move(in), types, {}};
}

constexpr Source input(int port = 0) { return {Source::kInput, port}; }

std::string refusal(const Graph& g, const std::vector<quell_shape>& inputs) {
  try {
    const Plan plan(g, inputs);
  } catch (const Error& e) {
    EXPECT_EQ(e.exit(), Exit::usage);
    return e.what();
  }
  return "";
}

TEST(PlanShapes, OfANodeThatReadsOnlyThePastOfALaterOne) {
  Graph g;
  g.inputs = {{"i", QUELL_FEATURES, false}};
  g.nodes.push_back(make("first", "blend", {{{{2, 0}, 1, {}}}, {}}, QUELL_FEATURES));
  g.nodes.push_back(make("second", "blend", {{{{3, 0}, 1, {}}}, {{{0, 0}, 0, {}}}}, QUELL_FEATURES));
  g.nodes.push_back(make("third", "blend", {{{{3, 0}, 2, {}}}, {}}, QUELL_FEATURES));
  g.nodes.push_back(make("fourth", "blend", {{{input(), 0, {}}}, {{{1, 0}, 0, {}}}}, QUELL_FEATURES));
  g.outputs = {{"o", {{3, 0}, 0, {}}, QUELL_FEATURES, false}};
  const quell_shape shape{30, 20, 5};
  const Plan plan(g, {&shape, 1});
  for (const auto& v : plan.values()) {
    EXPECT_EQ(v.shape.width, 30) << v.name;
    EXPECT_EQ(v.shape.height, 20) << v.name;
    EXPECT_EQ(v.shape.channels, 5) << v.name;
  }
}

// A guess at a shape is not the graph's fault.
TEST(PlanShapes, ANodeIsHeardOnlyOfThoseThatAreSettled) {
  Graph g;
  g.inputs = {{"i", QUELL_FEATURES, false}, {"k", QUELL_SCALAR, false}};
  g.nodes.push_back(make("sorted", "sorts", {{{{1, 0}, 1, {}}}, {{input(1), 0, {}}}}));
  g.nodes.push_back(make("now", "blend", {{{input(), 0, {}}}, {{{0, 0}, 0, {}}}}, QUELL_FEATURES));
  g.outputs = {{"o", {{1, 0}, 0, {}}, QUELL_FEATURES, false}};
  EXPECT_EQ(refusal(g, {{8, 8, 3}, {8, 8, 1}}), "");
  try {
    const std::vector<quell_shape> one = {{8, 8, 1}, {8, 8, 1}};
    const Plan plan(g, one);
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "sorted (sorts): there is nothing to sort");
  }
}

TEST(PlanShapes, AStartGivesThemToo) {
  Graph g;
  g.inputs = {{"i", QUELL_SCALAR, false}};
  g.nodes.push_back(make("own", "blend", {{{{0, 0}, 1, {}}}, {}}));
  g.outputs = {{"o", {{0, 0}, 0, {}}, QUELL_SCALAR, false}};
  EXPECT_EQ(refusal(g, {{8, 8, 1}}),
            "own: its size is not known, for it reads nothing but the past; give a delayed wire a \"start\"");
  g.nodes[0].in[0][0].start = input();
  EXPECT_EQ(refusal(g, {{8, 8, 1}}), "");
}

TEST(PlanShapes, DoNotDependOnTheirOwnPast) {
  Graph g;
  g.inputs = {{"i", QUELL_SCALAR, false}};
  g.nodes.push_back(make("ever_less", "half", {{{{0, 0}, 1, input()}}}));
  g.outputs = {{"o", {{0, 0}, 0, {}}, QUELL_SCALAR, false}};
  EXPECT_NE(refusal(g, {{64, 64, 1}}), "");
}

TEST(PlanShapes, OneSizeANode) {
  Graph g;
  g.inputs = {{"i", QUELL_SCALAR, false}};
  g.nodes.push_back(make("half", "half", {{{input(), 0, {}}}}));
  g.nodes.push_back(make("blend", "blend", {{{input(), 0, {}}}, {{{0, 0}, 0, {}}}}));
  g.outputs = {{"o", {{1, 0}, 0, {}}, QUELL_SCALAR, false}};
  EXPECT_EQ(refusal(g, {{64, 32, 1}}),
            "blend: input 'b' is 32x16, but 'a' is 64x32: the images of a node have one size");
  g.nodes[1].in[1] = {{{1, 0}, 1, {0, 0}}};
  EXPECT_EQ(refusal(g, {{64, 32, 1}}),
            "blend: the start of input 'b' is 32x16 with 1 channels, but what it stands in for is 64x32 with 1");
}

// Features may be of any size elsewhere, but not where another image says where pixels lie.
TEST(PlanShapes, FeaturesOfAnotherSizeAreNoImageOfTypeAny) {
  Graph g;
  g.inputs = {{"i", QUELL_FEATURES, false}, {"k", QUELL_FEATURES, false}};
  g.nodes.push_back(make("blend", "blend", {{{input(), 0, {}}}, {{input(1), 0, {}}}}, QUELL_FEATURES));
  g.outputs = {{"o", {{0, 0}, 0, {}}, QUELL_FEATURES, false}};
  EXPECT_EQ(refusal(g, {{64, 32, 4}, {64, 32, 4}}), "");
  EXPECT_EQ(refusal(g, {{64, 32, 4}, {32, 32, 4}}),
            "blend: input 'b' is 32x32, but 'a' is 64x32: the images of a node have one size");
  EXPECT_EQ(refusal(g, {{64, 32, 4}, {64, 32, 2}}), "blend: input 'b' has 2 channels, but 'a' has 4");
}

// A cast says what features mean, not how many channels they have.
TEST(PlanShapes, ACastOfFeaturesNeedsTheChannels) {
  Graph g;
  g.inputs = {{"i", QUELL_FEATURES, false}};
  g.nodes.push_back(make("tint", "tint", {{{input(), 0, {}}}}));
  g.outputs = {{"o", {{0, 0}, 0, {}}, QUELL_RADIANCE, false}};
  EXPECT_EQ(refusal(g, {{8, 8, 3}}), "");
  EXPECT_EQ(refusal(g, {{8, 8, 1}}), "tint: input 'image' is radiance of 3 channels, but what it reads has 1");
  g.nodes[0] = make("blend", "blend", {{{input(), 0, {}}}, {}}, QUELL_RADIANCE);
  EXPECT_EQ(refusal(g, {{8, 8, 1}}), "blend: input 'a' is radiance of 3 channels, but what it reads has 1");
  g.nodes.clear();
  g.outputs[0].wire.from = input();
  EXPECT_EQ(refusal(g, {{8, 8, 2}}), "output 'o' is radiance of 3 channels, but 'i' has 2");
}

// Images of a list whose type no output takes over have one size, but channels of their own.
TEST(PlanShapes, AListOfUnlikeImages) {
  Graph g;
  g.inputs = {{"i", QUELL_FEATURES, false}, {"k", QUELL_SCALAR, false}};
  g.nodes.push_back(make("join", "join", {{{input(), 0, {}}, {input(1), 0, {}}, {input(), 1, {}}}}));
  g.outputs = {{"o", {{0, 0}, 0, {}}, QUELL_FEATURES, false}};
  EXPECT_EQ(refusal(g, {{8, 4, 5}, {8, 4, 1}}), "");
  const quell_shape shapes[] = {{8, 4, 5}, {8, 4, 1}};
  EXPECT_EQ(Plan(g, shapes).values()[2].shape.channels, 11);
  EXPECT_EQ(refusal(g, {{8, 4, 5}, {8, 5, 1}}),
            "join: input 'images' is 8x5, but 'images' is 8x4: the images of a node have one size");
  g.nodes[0].in[0] = {{input(), 0, {}}, {{0, 0}, 1, {}}};
  EXPECT_EQ(refusal(g, {{8, 4, 5}, {8, 4, 1}}),
            "join: output 'out' would grow from 8x4 with 320 channels to 8x4 with 325: a size cannot depend on its own "
            "past");
  g.nodes[0].in[0].push_back({{0, 0}, 1, {}});
  EXPECT_EQ(refusal(g, {{8, 4, 5}, {8, 4, 1}}), "join: input 'images' would have more than 65536 channels");
}

TEST(PlanShapes, WeightsHaveTheSizeOfWhatTheyFilter) {
  Graph g;
  g.inputs = {{"i", QUELL_SCALAR, false}};
  g.nodes.push_back(make("half", "half", {{{input(), 0, {}}}}));
  g.nodes.push_back(make("by_likeness", "likeness", {{{{0, 0}, 0, {}}}}));
  g.nodes.push_back(make("filter", "filter", {{{input(), 0, {}}}, {{{1, 0}, 0, {}}}}));
  g.outputs = {{"o", {{2, 0}, 0, {}}, QUELL_SCALAR, false}};
  EXPECT_EQ(refusal(g, {{64, 32, 1}}),
            "filter: input 'weights' is 32x16, but 'image' is 64x32: the images of a node have one size");
}

class OneFrame : public FrameSource {
 public:
  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t) const override { return false; }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t, std::span<const std::string>) override { return {{9, 9, 1}}; }
  void read(std::int64_t, std::span<const std::string>, std::span<const quell_image> into) override {
    into[0].plane[0][0] = 41;
  }
  std::map<std::string, Repairs> repairs() const override { return {}; }

 private:
  std::vector<std::int64_t> frames_{1};
  std::map<std::string, int> roles_{{"i", QUELL_SCALAR}};
};

class KeepNumber : public FrameSink {
 public:
  void write(std::int64_t, std::span<const quell_image> outputs) override { number = outputs[0].plane[0][0]; }
  float number = 0;
};

TEST(Executor, ANodeWhoseImagesDoNotExistStillGivesItsValue) {
  Graph g;
  g.inputs = {{"i", QUELL_SCALAR, false}};
  g.nodes.push_back(make("measure", "measure", {{{input(), 0, {}}}, {}}));
  g.outputs = {{"o", {{0, 1}, 0, {}}, QUELL_VALUE, false}};
  OneFrame source;
  KeepNumber sink;
  run_graph(g, source, sink, {});
  EXPECT_EQ(sink.number, 42.0f);
}

}  // namespace
}  // namespace quell::test
