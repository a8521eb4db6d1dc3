// Laying JSON over JSON, and reading options.
#include "core/graph/variant.h"

#include <gtest/gtest.h>

namespace quell {
namespace {

struct Laid {
  Json json;
  std::string messages;
};
Laid lay(const char* base, const char* over) {
  Diagnostics d;
  Faults faults(d);
  auto json = overlay(*parse_json("base", base, d), *parse_json("over", over, d), faults);
  return {std::move(json), d.format()};
}
std::string shown(const Json& j) {
  if (!j.is(Json::Kind::object)) return j.shown();
  std::string out = "{";
  for (const auto& m : j.members) out += (out.size() > 1 ? " " : "") + m.key + ":" + shown(m.value);
  return out + "}";
}

TEST(Overlay, ReplacesAddsAndRemovesKeepingTheOrder) {
  const auto l = lay(R"({"name": "a", "params": {"x": 1, "y": 2, "z": 3}})",
                     R"({"params": {"y": null, "x": 5, "w": 6}, "name": "b", "about": "c"})");
  EXPECT_EQ(shown(l.json), "{name:\"b\" params:{x:5 z:3 w:6} about:\"c\"}");
  EXPECT_EQ(l.messages, "");
}

TEST(Overlay, NodesAreMergedDownToTheirPorts) {
  const auto l =
      lay(R"({"nodes": {"n": {"type": "t", "in": {"a": "x", "b": {"from": "y", "as": "z"}}, "set": {"p": 1}}}})",
          R"({"nodes": {"n": {"in": {"b": {"from": "w"}}, "set": {"p": null, "q": 2}}}})");
  EXPECT_EQ(shown(l.json), "{nodes:{n:{type:\"t\" in:{a:\"x\" b:{from:\"w\"}} set:{q:2}}}}");
}

TEST(Overlay, ATypeTakesThePlaceOfAGraph) {
  EXPECT_EQ(shown(lay(R"({"nodes": {"n": {"graph": "g", "in": {}}}})", R"({"nodes": {"n": {"type": "t"}}})").json),
            "{nodes:{n:{in:{} type:\"t\"}}}");
  EXPECT_EQ(shown(lay(R"({"nodes": {"n": {"type": "t"}}})", R"({"nodes": {"n": {"graph": "g"}}})").json),
            "{nodes:{n:{graph:\"g\"}}}");
}

TEST(Overlay, RemovingWhatIsNotThereIsAnError) {
  EXPECT_EQ(lay(R"({"params": {"x": 1}})", R"({"params": {"y": null}})").messages,
            "over:1:18: error: params.y: there is no 'y' in the base that null could remove\n");
}

TEST(Overlay, ShortFormsAreNotLaidOver) {
  EXPECT_EQ(shown(lay(R"({"name": "a"})", R"({"base": "b", "set": {}, "swap": {}, "wire": {}, "bypass": []})").json),
            "{name:\"a\"}");
}

TEST(Changes, AreAppliedSwapsFirst) {
  Diagnostics d;
  Faults faults(d);
  const auto changes = parse_changes(
      *parse_json("v", R"({"set": {"a.p": 1}, "bypass": "b", "wire": {"a.in": "x@-1"}, "swap": {"a": "t"}})", d),
      faults);
  ASSERT_EQ(changes.size(), 4u) << d.format();
  EXPECT_EQ(changes[0].kind, Change::Kind::swap);
  EXPECT_EQ(changes[1].kind, Change::Kind::wire);
  EXPECT_EQ(changes[1].binding.port, "in");
  EXPECT_EQ(changes[1].binding.wires[0].from.delay, 1);
  EXPECT_EQ(changes[2].kind, Change::Kind::bypass);
  EXPECT_EQ(changes[3].value.integer, 1);
}

std::vector<std::string> left_under(const char* over) {
  Diagnostics d;
  Faults faults(d);
  auto changes = parse_changes(*parse_json("base", R"({"set": {"p": 1, "a.p": 1, "a.b.p": 1}, "bypass": ["a"],
      "wire": {"a.in": "x", "a.b.in": "x"}, "swap": {"a": "t", "a.b": "t"}})",
                                           d),
                               faults);
  drop_overridden(changes, *parse_json("over", over, d));
  static constexpr const char* kKinds[] = {"swap ", "wire ", "bypass ", "set "};
  std::vector<std::string> left;
  for (const auto& c : changes) {
    left.push_back(kKinds[int(c.kind)] + c.target[0]);
    for (std::size_t i = 1; i < c.target.size(); ++i) left.back() += "." + c.target[i];
  }
  EXPECT_EQ(d.format(), "");
  return left;
}

TEST(Changes, OfABaseGiveWayToTheKeysOfAVariant) {
  using Names = std::vector<std::string>;
  const Names all{"swap a", "swap a.b", "wire a.in", "wire a.b.in", "bypass a", "set p", "set a.p", "set a.b.p"};
  const auto without = [&](const char* name) {
    Names some = all;
    std::erase(some, name);
    return some;
  };
  EXPECT_EQ(left_under(R"({"params": {"q": 1}, "nodes": {"b": null, "a": {"set": {"q": 1}, "in": {"o": "x"}}}})"), all);
  EXPECT_EQ(left_under(R"({"params": {"p": 2}})"), without("set p"));
  EXPECT_EQ(left_under(R"({"nodes": {"a": {"set": {"p": 2}}}})"), without("set a.p"));
  EXPECT_EQ(left_under(R"({"nodes": {"a": {"in": {"in": null}}}})"), without("wire a.in"));
  EXPECT_EQ(left_under(R"({"nodes": {"a": {"type": "u"}}})"), without("swap a"));
  EXPECT_EQ(left_under(R"({"nodes": {"a": {"bypass": false}}})"), without("bypass a"));
  EXPECT_EQ(left_under(R"({"nodes": {"a": null}})"), Names{"set p"});
  EXPECT_EQ(left_under(R"({"nodes": 1, "params": []})"), all);
}

TEST(Options, BecomeSourcesOfTheirOwn) {
  Diagnostics d;
  Faults faults(d);
  const Edit edits[] = {{Edit::Kind::set, "a.p=x y"},
                        {Edit::Kind::set, "a.q=\"2\""},
                        {Edit::Kind::wire, "a.in=b,c.d@-2"},
                        {Edit::Kind::tap, "a.out"},
                        {Edit::Kind::set, "a.r=[1,2]"}};
  const auto read = parse_edits(edits, faults);
  ASSERT_EQ(read.changes.size(), 4u) << d.format();
  EXPECT_EQ(d.sources.place(read.changes[2].position), "--set #2");
  EXPECT_EQ(read.changes[0].binding.wires.size(), 2u);
  EXPECT_EQ(read.changes[0].binding.wires[1].from.delay, 2);
  EXPECT_EQ(read.changes[1].value.text, "x y");
  EXPECT_EQ(read.changes[2].value.text, "2");
  EXPECT_EQ(read.changes[3].value.items.size(), 2u);
  ASSERT_EQ(read.taps.size(), 1u);
  EXPECT_EQ(read.taps[0].name, "a.out");
}

}  // namespace
}  // namespace quell
