// What people read about a node type, to the letter.
#include "core/plugin/document.h"

#include "tests/support/graph_nodes.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace quell::test {
namespace {

const NodeType& type(const char* name) { return *graph_registry().find(name); }

TEST(Document, Text) {
  EXPECT_EQ(
      document_text(type("atrous")),
      "atrous  One level of the wavelet filter with holes.\n"
      "\nInputs\n"
      "  image     any         What is filtered.\n"
      "  variance  variance?   Variance, filtered alongside.\n"
      "  weights   weight[]    Edge-stopping functions.\n"
      "\nOutputs\n"
      "  image     any         The weighted mean. A bypass gives its input image.\n"
      "  variance  variance    Variance of the mean. A bypass gives its input variance. Exists only with its input "
      "variance.\n"
      "\nParameters\n"
      "  step      Distance between taps, pixels.\n"
      "            a whole number from 1 to 64; default 1\n");
}

TEST(Document, Markdown) {
  EXPECT_EQ(document_markdown(type("normal_weight")),
            "## normal_weight\n\nUnlikeness of normals.\n"
            "\nA weight node: wire it into the `weights` of a filter.\n"
            "\n| input | type | |\n|---|---|---|\n| `normal` | normal | World-space unit normals. |\n"
            "\n| output | type | |\n|---|---|---|\n| `weight` | weight | A power of the cosine. |\n"
            "\n| parameter | takes | default | |\n|---|---|---|---|\n"
            "| `mode` | one of power, angle | `\"power\"` | Falloff. |\n"
            "| `power` | a number from 1 to 4096 | `128` | Of the cosine; higher is stricter. |\n"
            "| `sigma` | a number from 0.001 to 10 | `0.1` | Standard deviation of the angle, radians. |\n");
}

TEST(Document, Json) {
  const auto j = nlohmann::json::parse(document_json(type("grade")));
  EXPECT_EQ(j["name"], "grade");
  EXPECT_EQ(j["weight"], false);
  EXPECT_EQ(j["outputs"][0]["type"], "display");
  EXPECT_EQ(j["params"][0]["kind"], "floats");
  EXPECT_EQ(j["params"][0]["count"], 3);
  EXPECT_EQ(j["params"][0]["min"], -1);
  EXPECT_EQ(j["params"][0]["default"], nlohmann::json::parse("[0, 0, 0]"));
  EXPECT_EQ(j["params"][2]["kind"], "path");
  const auto a = nlohmann::json::parse(document_json(type("atrous")));
  EXPECT_EQ(a["outputs"][1]["passes"], "variance");
  EXPECT_EQ(a["outputs"][1]["with"], "variance");
  EXPECT_EQ(a["inputs"][2]["list"], true);
}

}  // namespace
}  // namespace quell::test
