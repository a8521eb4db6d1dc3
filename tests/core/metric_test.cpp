// Metrics: what makes a graph one, and how it joins the graph that it judges.
#include "core/lab/metric.h"

#include "core/report/error.h"
#include "tests/support/add_type.h"
#include "tests/support/graph_nodes.h"
#include "tests/support/scratch.h"

#include <quell/node.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace quell::test {
namespace {

// What metrics are made of here: a node without work.
struct Judge {
  In<Radiance> image, before, reference;
  In<Motion> motion;
  In<Id> id, id_before;
  Out<Value> value;
  Out<Scalar> map;
  void describe(Describe& d) {
    d.summary("Judges an image.");
    d.in(image, "image", "What is judged.");
    d.in(before, "before", "The same, one frame earlier.").anywhere();
    d.in(reference, "reference", "What it is judged by.");
    d.in(motion, "motion", "Pixels, previous - current.");
    d.in(id, "id", "Object now.").optional();
    d.in(id_before, "id_before", "Object one frame earlier.").optional().anywhere();
    d.out(value, "value", "A number.");
    d.out(map, "map", "An image.");
  }
  void run(const Tile&) const {}
};

Registry& judges() {
  static Registry registry({});
  static const bool added = add_type<Judge>(registry, "judge");
  EXPECT_TRUE(added);
  return registry;
}

// Looks at this frame and the last one, and at roles of the sequence.
constexpr const char* kBody = R"(
  "name": "Steadiness", "about": "How steady.", "metric": { "better": "higher", "unit": "dB", "perfect": 1000 },
  "inputs": { "image": "radiance", "reference": "radiance", "motion": "motion", "id": "id?" },
  "nodes": {
    "first": { "type": "judge", "in": { "image": "image", "before": "image@-1", "reference": "reference",
                                        "motion": "motion", "id": "id", "id_before": "id@-1" } },
    "again": { "type": "judge", "in": { "image": "image", "reference": "reference", "motion": "motion",
               "before": { "from": "reference@-2", "start": "image" } } }
  },
  "outputs": { "value": "first.value", "pixels": "again.value", "map": "first.map@-1" })";

class Metrics : public testing::Test {
 protected:
  Metrics() { std::filesystem::create_directory(scratch_.path("metrics")); }
  void write(const std::string& name, const std::string& body) {
    std::ofstream(scratch_.path("metrics/" + name + ".json")) << "{ \"quell\": 1, " << body << " }";
  }
  std::optional<Metric> load_it(const std::string& name, std::optional<std::map<std::string, int>> roles = {}) {
    Diagnostics diagnostics;
    auto metric = load_metric(name, scratch_.folder(), judges(), diagnostics, std::move(roles));
    messages_ = diagnostics.format();
    return metric;
  }
  // What is said of a metric with this body.
  std::string said(const std::string& body) {
    write("bad", body);
    load_it("bad");
    const auto at = messages_.find("'");
    const auto end = messages_.find("' ", at + 1);
    return end == messages_.npos ? messages_ : messages_.substr(end + 2);
  }

  Scratch scratch_;
  std::string messages_;
};

TEST_F(Metrics, AreLoadedByNameAndByFile) {
  write("steadiness", kBody);
  write("other", kBody);
  EXPECT_EQ(installed_metrics(scratch_.folder()), (std::vector<std::string>{"other", "steadiness"}));
  for (const auto& name : {std::string("steadiness"), scratch_.path("metrics/steadiness.json")}) {
    const auto metric = load_it(name);
    ASSERT_TRUE(metric) << messages_;
    EXPECT_EQ(messages_, "");
    EXPECT_EQ(metric->name, "steadiness");
    EXPECT_EQ(metric->title, "Steadiness");
    EXPECT_EQ(metric->about, "How steady.");
    EXPECT_TRUE(metric->key.higher_is_better);
    EXPECT_EQ(metric->key.unit, "dB");
    EXPECT_EQ(metric->key.perfect, 1000);
  }
}

TEST_F(Metrics, VaryAsGraphsDo) {
  write("steadiness", kBody);
  write("lower", R"("base": "steadiness.json", "metric": { "better": "lower" })");
  const auto metric = load_it("lower");
  ASSERT_TRUE(metric) << messages_;
  EXPECT_FALSE(metric->key.higher_is_better);
  EXPECT_EQ(metric->key.unit, "");
  EXPECT_EQ(metric->key.perfect, std::nullopt);
  EXPECT_EQ(metric->title, "Steadiness");
}

TEST_F(Metrics, SayWhatTheyLack) {
  write("steadiness", kBody);
  EXPECT_FALSE(load_it("stediness"));
  EXPECT_EQ(
      messages_,
      "error: there is no metric 'stediness'\n  installed are: steadiness. Did you mean 'steadiness'?\n  a file is "
      "named with its folder or with .json\n");
  EXPECT_EQ(said(R"("inputs": { "image": "radiance" }, "outputs": { "value": "image" })"),
            "is no metric: it lacks \"metric\", as in \"metric\": { \"better\": \"lower\" }\n");
  const std::string key = R"("metric": { "better": "lower" }, )";
  EXPECT_EQ(said(key + R"("inputs": { "color": "radiance" }, "outputs": { "value": "color" })"),
            "is no metric: it lacks the input 'image', which is judged\n");
  EXPECT_EQ(said(key + R"("inputs": { "image": "radiance" }, "outputs": { "color": "image" })"),
            "is no metric: it lacks the output 'value', its number\n");
  EXPECT_EQ(said(key + R"("inputs": { "image": "radiance" }, "outputs": { "value": "image" })"),
            "gives 'value' as radiance, but of a metric that is a value\n");
  const auto outputs = [](const std::string& text) {
    const std::string body = kBody;
    return body.substr(0, body.find("\"outputs\"")) + "\"outputs\": { \"value\": \"first.value\", " + text + " }";
  };
  EXPECT_EQ(said(outputs(R"("pixels": "again.map")")), "gives 'pixels' as scalar, but of a metric that is a value\n");
  EXPECT_EQ(said(outputs(R"("pixels": "again.value", "map": "image")")),
            "gives 'map' as radiance, but of a metric that is a scalar\n");
}

TEST_F(Metrics, SayWhichRolesTheyMiss) {
  write("steadiness", kBody);
  EXPECT_FALSE(load_it("steadiness", {{{"image", QUELL_RADIANCE}, {"motion", QUELL_MOTION}}}));
  EXPECT_NE(messages_.find("the sequence has no 'reference'"), std::string::npos) << messages_;
}

// A graph with an output that its nodes make, read by a metric that looks back.
TEST_F(Metrics, JoinTheGraphThatTheyJudge) {
  write("steadiness", kBody);
  const auto metric =
      load_it("steadiness", {{{"image", QUELL_RADIANCE}, {"reference", QUELL_RADIANCE}, {"motion", QUELL_MOTION}}});
  ASSERT_TRUE(metric) << messages_;
  auto loaded = load_text(R"({ "quell": 1, "inputs": { "color": "radiance", "motion": "motion" },
    "nodes": { "blur": { "type": "gaussian", "in": { "image": "color" } } },
    "outputs": { "before": "color", "color": "blur", "flow": "motion" } })");
  ASSERT_TRUE(loaded.graph) << loaded.messages;
  auto& graph = *loaded.graph;
  attach_metric(graph, 1, *metric, "color.steadiness");
  EXPECT_EQ(shown(graph),
            "blur <- image:color\n"
            "color.steadiness.first <- image:blur.image before:blur.image@-1 reference:reference motion:motion\n"
            "color.steadiness.again <- image:blur.image before:reference@-2|blur.image reference:reference "
            "motion:motion\n"
            "before = color\n"
            "color = blur.image\n"
            "flow = motion\n"
            "tap color.steadiness.value = color.steadiness.first.value\n"
            "tap color.steadiness.pixels = color.steadiness.again.value\n"
            "tap color.steadiness.map = color.steadiness.first.map@-1\n");
  ASSERT_EQ(graph.inputs.size(), 3u) << "motion is shared, and the optional id is not there";
  EXPECT_EQ(graph.inputs[2].name, "reference");
  EXPECT_EQ(graph.outputs[3].type, QUELL_VALUE);
  attach_metric(graph, 0, *metric, "before.steadiness", {"value"});
  ASSERT_EQ(graph.outputs.size(), 7u);
  EXPECT_EQ(graph.outputs[6].name, "before.steadiness.value");
  EXPECT_EQ(graph.inputs.size(), 3u);
  EXPECT_EQ(graph.nodes[3].in[1].at(0), (Wire{{Source::kInput, 0}, 1, {}})) << "the judged input, one frame earlier";
}

TEST_F(Metrics, RefuseWhatDoesNotFit) {
  write("steadiness", kBody);
  const auto metric = load_it("steadiness");
  ASSERT_TRUE(metric) << messages_;
  const auto said_of = [&](const char* text) -> std::string {
    auto loaded = load_text(text);
    if (!loaded.graph) return loaded.messages;
    try {
      attach_metric(*loaded.graph, 0, *metric, "m");
    } catch (const Error& e) {
      return e.exit() == Exit::usage ? e.what() : "not of this kind";
    }
    return "";
  };
  EXPECT_EQ(said_of(R"({ "quell": 1, "inputs": { "color": "albedo" }, "outputs": { "color": "color" } })"),
            "the metric 'steadiness' judges radiance, but the output 'color' is albedo");
  EXPECT_EQ(said_of(R"({ "quell": 1, "inputs": { "color": "radiance", "reference": "albedo" },
                         "outputs": { "color": "color", "other": "reference" } })"),
            "the metric 'steadiness' takes 'reference' as radiance, but the graph takes it as albedo");
  EXPECT_EQ(said_of(R"({ "quell": 1, "inputs": { "color": "radiance" }, "outputs": { "color": "color@-1" } })"),
            "the metric 'steadiness' looks back at what it judges, but the output 'color' is delayed itself; let the "
            "graph give what it delays as an output");
}

}  // namespace
}  // namespace quell::test
