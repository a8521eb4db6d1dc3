// Each rule of a plugin's table: broken alone, it gives its own message.
#include "core/plugin/registry.h"

#include <quell/abi.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace quell {

namespace {

struct Values {
  std::int32_t radius = 3;
  float sigma[2] = {1, 2};
  std::int32_t mode = 0;
  quell_text label = {"", 0};
  std::uint8_t on = 1;
};

std::int32_t run(const void*, const void*, const quell_tile*, quell_error*) { return 0; }
void weigh(const void*, const void*, const quell_input*, const quell_run*, float*) {}
std::int32_t prepare(const void*, const quell_spec*, void**, quell_error*) { return 0; }
void release(void*) {}
std::int32_t shapes(const void*, const quell_spec*, quell_shape*, quell_error*) { return 0; }

// A table in which every rule is kept, to be broken in one place.
struct Table {
  Values values;
  std::array<const char*, 2> choices{"fast", "exact"};
  std::array<quell_port, 2> in{
      {{"image", "Image.", QUELL_RADIANCE, 0, -1, -1}, {"guide", "Guide.", QUELL_NORMAL, QUELL_OPTIONAL, -1, -1}}};
  std::array<quell_port, 2> out{
      {{"image", "Result.", QUELL_RADIANCE, 0, 0, -1}, {"extra", "Only with a guide.", QUELL_SCALAR, 0, -1, 1}}};
  std::array<quell_param, 5> param{
      {{"radius", "Radius.", QUELL_INT, 1, offsetof(Values, radius), 1, 16, nullptr, 0, 0},
       {"sigma", "Sigmas.", QUELL_FLOATS, 2, offsetof(Values, sigma), 0, 10, nullptr, 0, 0},
       {"mode", "Mode.", QUELL_CHOICE, 1, offsetof(Values, mode), 0, 1, choices.data(), 2, 0},
       {"label", "Label.", QUELL_TEXT, 1, offsetof(Values, label), 0, 0, nullptr, 0, 0},
       {"on", "Switch.", QUELL_BOOL, 1, offsetof(Values, on), 0, 1, nullptr, 0, 0}}};
  quell_node node{};
  std::array<const quell_node*, 2> nodes{&node, &node};
  quell_plugin_table table{QUELL_MAGIC, QUELL_ABI_MAJOR, QUELL_ABI_MINOR, sizeof(quell_plugin_table),
                           1,           nodes.data(),    "1.0",           "test"};

  Table() {
    node.size = sizeof node;
    node.name = "sample";
    node.summary = "Does nothing.";
    node.source = "";
    node.in = in.data(), node.in_count = int(in.size());
    node.out = out.data(), node.out_count = int(out.size());
    node.param = param.data(), node.param_count = int(param.size());
    node.instance_size = sizeof values, node.instance_align = alignof(Values), node.defaults = &values;
    node.run = &run;
  }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;
};

struct Rule {
  const char* name;
  std::function<void(Table&)> break_it;
  std::vector<std::string> expected;
};

void PrintTo(const Rule& rule, std::ostream* out) { *out << rule.name; }

std::string in_node(const std::string& text) { return "node 'sample': " + text; }
const float kNaN = std::numeric_limits<float>::quiet_NaN();

const std::vector<Rule>& rules() {
  static const std::vector<Rule> list = {
      {"Nothing", [](Table&) {}, {}},
      {"Magic", [](Table& t) { t.table.magic = 7; }, {"the table's magic number is 0x00000007, expected 0x4c4c4551"}},
      {"Major",
       [](Table& t) { t.table.abi_major = 9; },
       {"built for plugin ABI 9.0, this program has 1.0: rebuild the plugin"}},
      {"Minor",
       [](Table& t) { t.table.abi_minor = 3; },
       {"built for plugin ABI 1.3, this program has 1.0: rebuild the plugin"}},
      {"TableSize", [](Table& t) { t.table.size = 8; }, {"the table's size is 8, expected 40"}},
      {"Version", [](Table& t) { t.table.version = nullptr; }, {"version or compiler is null"}},
      {"Compiler", [](Table& t) { t.table.compiler = nullptr; }, {"version or compiler is null"}},
      {"NoNodes", [](Table& t) { t.table.node_count = 0, t.table.nodes = nullptr; }, {"0 nodes at 0x0"}},
      {"NullNodes", [](Table& t) { t.table.nodes = nullptr; }, {"1 nodes at 0x0"}},
      {"NegativeNodes", [](Table& t) { t.table.node_count = -1, t.table.nodes = nullptr; }, {"-1 nodes at 0x0"}},
      {"NullNode", [](Table& t) { t.nodes[0] = nullptr; }, {"node 0: is null"}},
      {"NodeTwice", [](Table& t) { t.table.node_count = 2; }, {"two nodes are called 'sample'"}},
      {"NodeSize", [](Table& t) { t.node.size = 3; }, {"node 0: size is 3, expected 152"}},
      {"NodeName",
       [](Table& t) { t.node.name = "Sample"; },
       {"node 0: name 'Sample' is not of the form [a-z][a-z0-9_]*"}},
      {"NodeNameEmpty", [](Table& t) { t.node.name = ""; }, {"node 0: name '' is not of the form [a-z][a-z0-9_]*"}},
      {"NodeNameNull",
       [](Table& t) { t.node.name = nullptr; },
       {"node 0: name (null) is not of the form [a-z][a-z0-9_]*"}},
      {"NodeNamePath",
       [](Table& t) { t.node.name = "a/b"; },
       {"node 0: name 'a/b' is not of the form [a-z][a-z0-9_]*"}},
      {"Summary", [](Table& t) { t.node.summary = ""; }, {in_node("has no summary")}},
      {"Source", [](Table& t) { t.node.source = nullptr; }, {in_node("source is null")}},
      {"NullInputs", [](Table& t) { t.node.in = nullptr; }, {in_node("2 inputs at 0x0")}},
      {"TooManyInputs", [](Table& t) { t.node.in = nullptr, t.node.in_count = 5000; }, {in_node("5000 inputs at 0x0")}},
      {"NullOutputs", [](Table& t) { t.node.out = nullptr; }, {in_node("2 outputs at 0x0")}},
      {"NullParams", [](Table& t) { t.node.param = nullptr; }, {in_node("5 parameters at 0x0")}},
      {"NoOutput", [](Table& t) { t.node.out_count = 0; }, {in_node("has no output")}},
      {"AlignZero", [](Table& t) { t.node.instance_align = 0; }, {in_node("instance_align is 0")}},
      {"AlignOdd", [](Table& t) { t.node.instance_align = 12; }, {in_node("instance_align is 12")}},
      {"AlignHuge", [](Table& t) { t.node.instance_align = 8192; }, {in_node("instance_align is 8192")}},
      {"InstanceHuge",
       [](Table& t) { t.node.instance_size = std::size_t{1} << 40; },
       {in_node("instance_size is 1099511627776")}},
      {"NoDefaults", [](Table& t) { t.node.defaults = nullptr; }, {in_node("defaults is null")}},
      {"NoRun", [](Table& t) { t.node.run = nullptr; }, {in_node("must have exactly one of run and weigh")}},
      {"PrepareAlone",
       [](Table& t) { t.node.prepare = &prepare; },
       {in_node("must have both or none of prepare and release")}},
      {"ReleaseAlone",
       [](Table& t) { t.node.release = &release; },
       {in_node("must have both or none of prepare and release")}},
      {"InputName",
       [](Table& t) { t.in[1].name = "a-b"; },
       {in_node("input 1: name 'a-b' is not of the form [a-z][a-z0-9_]*")}},
      {"InputDoc", [](Table& t) { t.in[0].doc = nullptr; }, {in_node("input 'image' has no doc")}},
      {"InputType", [](Table& t) { t.in[1].type = 77; }, {in_node("input 'guide': there is no type 77")}},
      {"InputFlags", [](Table& t) { t.in[1].flags = 12; }, {in_node("input 'guide': unknown flags 0xc")}},
      {"InputTwice", [](Table& t) { t.in[1].name = "image"; }, {in_node("two inputs are called 'image'")}},
      {"OutputTwice", [](Table& t) { t.out[1].name = "image"; }, {in_node("two outputs are called 'image'")}},
      {"OutputFlags", [](Table& t) { t.out[1].flags = QUELL_OPTIONAL; }, {in_node("output 'extra' has flags")}},
      {"OutputAny",
       [](Table& t) { t.out[1].type = QUELL_ANY; },
       {in_node("output 'extra' is of type any, but no input is")}},
      {"PassesNothing", [](Table& t) { t.out[0].passes = 2; }, {in_node("output 'image' passes input 2 of 2")}},
      {"PassesAnother",
       [](Table& t) { t.out[0].passes = 1; },
       {in_node("output 'image' passes an input of another type")}},
      {"WithNothing", [](Table& t) { t.out[1].with = -5; }, {in_node("output 'extra' is with input -5 of 2")}},
      {"WeightFromFilter",
       [](Table& t) { t.out[1].type = QUELL_WEIGHT; },
       {in_node("output 'extra': weight nodes, and only they, give weights")}},
      {"FilterFromWeight",
       [](Table& t) {
         t.node.run = nullptr, t.node.weigh = &weigh;
         t.node.out_count = 1;
       },
       {in_node("output 'image': weight nodes, and only they, give weights")}},
      {"WeightWithTwo",
       [](Table& t) {
         t.node.run = nullptr, t.node.weigh = &weigh;
         t.out[0].type = t.out[1].type = QUELL_WEIGHT;
         t.out[0].passes = -1;
       },
       {in_node("a weight node has one output, not 2")}},
      {"WeightOfWeight",
       [](Table& t) {
         t.node.run = nullptr, t.node.weigh = &weigh;
         t.node.out_count = 1;
         t.out[0].type = QUELL_WEIGHT, t.out[0].passes = -1;
         t.in[1].type = QUELL_WEIGHT;
       },
       {in_node("input 'guide': a weight node takes no weights")}},
      {"SourceWithoutSize",
       [](Table& t) {
         t.node.in_count = 0;
         t.out[0].passes = t.out[1].with = -1;
       },
       {in_node("has no image inputs, so it needs shapes")}},
      {"SourceWithSize",
       [](Table& t) {
         t.node.in_count = 0, t.node.shapes = &shapes;
         t.out[0].passes = t.out[1].with = -1;
       },
       {}},
      {"ParamName",
       [](Table& t) { t.param[0].name = "2nd"; },
       {in_node("parameter 0: name '2nd' is not of the form [a-z][a-z0-9_]*")}},
      {"ParamDoc", [](Table& t) { t.param[0].doc = ""; }, {in_node("parameter 'radius' has no doc")}},
      {"ParamTwice", [](Table& t) { t.param[4].name = "mode"; }, {in_node("two parameters are called 'mode'")}},
      {"ParamKind", [](Table& t) { t.param[0].kind = 9; }, {in_node("parameter 'radius': kind 9 with count 1")}},
      {"ParamCount",
       [](Table& t) { t.param[0].count = 1000; },
       {in_node("parameter 'radius': kind 2 with count 1000")}},
      {"FloatsCount", [](Table& t) { t.param[1].count = 0; }, {in_node("parameter 'sigma': kind 5 with count 0")}},
      {"ParamOutside",
       [](Table& t) { t.param[0].offset = 40; },
       {in_node("parameter 'radius': offset 40 is outside the instance of 40 bytes")}},
      {"ParamFarOutside",
       [](Table& t) { t.param[0].offset = std::numeric_limits<std::size_t>::max(); },
       {in_node("parameter 'radius': offset 18446744073709551615 is outside the instance of 40 bytes")}},
      {"FloatsOutside",
       [](Table& t) { t.param[1].count = std::numeric_limits<std::int32_t>::max(); },
       {in_node("parameter 'sigma': offset 4 is outside the instance of 40 bytes")}},
      {"ParamUnaligned",
       [](Table& t) { t.param[0].offset = 1; },
       {in_node("parameter 'radius': offset 1 in an instance aligned to 8 is not aligned to 4")}},
      {"InstanceUnaligned",
       [](Table& t) { t.node.instance_align = 4; },
       {in_node("parameter 'label': offset 16 in an instance aligned to 4 is not aligned to 8")}},
      {"RangeEmpty",
       [](Table& t) { t.param[0].min = 5, t.param[0].max = 4; },
       {in_node("parameter 'radius': range [5, 4] is empty"),
        in_node("parameter 'radius': default 3 is outside [5, 4]")}},
      {"RangeNaN",
       [](Table& t) { t.param[3].max = double(kNaN); },
       {in_node("parameter 'label': range [0, nan] is empty")}},
      {"DefaultOutside",
       [](Table& t) { t.values.radius = 17; },
       {in_node("parameter 'radius': default 17 is outside [1, 16]")}},
      {"DefaultNaN",
       [](Table& t) { t.values.sigma[1] = kNaN; },
       {in_node("parameter 'sigma': default nan is outside [0, 10]")}},
      {"DefaultOfBool", [](Table& t) { t.values.on = 2; }, {in_node("parameter 'on': default 2 is neither 0 nor 1")}},
      {"DefaultText",
       [](Table& t) { t.values.label.data = nullptr; },
       {in_node("parameter 'label': its default text is null")}},
      {"NoChoices", [](Table& t) { t.param[2].choice_count = 0; }, {in_node("parameter 'mode' has no choices")}},
      {"NullChoices", [](Table& t) { t.param[2].choices = nullptr; }, {in_node("parameter 'mode' has no choices")}},
      {"NamelessChoice", [](Table& t) { t.choices[1] = ""; }, {in_node("parameter 'mode': choice 1 has no name")}},
      {"DefaultChoice",
       [](Table& t) { t.values.mode = 2; },
       {in_node("parameter 'mode': default 2 is none of its 2 choices")}},
      {"TwoAtOnce",
       [](Table& t) { t.node.summary = nullptr, t.values.radius = 0; },
       {in_node("has no summary"), in_node("parameter 'radius': default 0 is outside [1, 16]")}},
  };
  return list;
}

class ValidateTable : public testing::TestWithParam<Rule> {};

TEST_P(ValidateTable, SaysWhatIsWrong) {
  Table table;
  GetParam().break_it(table);
  EXPECT_EQ(validate(&table.table), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(EachRule, ValidateTable, testing::ValuesIn(rules()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Validate, RefusesNull) { EXPECT_EQ(validate(nullptr), std::vector<std::string>{"quell_plugin() returned null"}); }

}  // namespace

}  // namespace quell
