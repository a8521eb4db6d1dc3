// Positioned JSON: values, places, and syntax errors to the letter.
#include "core/json/json.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>

namespace quell {
namespace {

struct Parsed {
  std::optional<Json> json;
  std::string errors;
};
Parsed parse(std::string text) {
  Diagnostics d;
  auto json = parse_json("t", std::move(text), d);
  return {std::move(json), d.format()};
}
std::string error_of(std::string text) {
  const auto parsed = parse(std::move(text));
  EXPECT_FALSE(parsed.json);
  return parsed.errors;
}

TEST(Json, ReadsEveryKind) {
  const auto p =
      parse(R"({"n": null, "t": true, "f": false, "i": -7, "d": 1.5, "s": "a\u0041\n", "l": [1, []], "o": {}})");
  ASSERT_TRUE(p.json) << p.errors;
  const Json& j = *p.json;
  EXPECT_TRUE(j.find("n")->is(Json::Kind::null));
  EXPECT_TRUE(j.find("t")->boolean);
  EXPECT_FALSE(j.find("f")->boolean);
  EXPECT_EQ(j.find("i")->integer, -7);
  EXPECT_EQ(j.find("i")->number, -7.0);
  EXPECT_EQ(j.find("d")->number, 1.5);
  EXPECT_EQ(j.find("s")->text, "aA\n");
  EXPECT_EQ(j.find("l")->items.size(), 2u);
  EXPECT_TRUE(j.find("o")->is(Json::Kind::object));
  EXPECT_EQ(j.find("absent"), nullptr);
  EXPECT_EQ(j.members[4].key, "d");
}

TEST(Json, KnowsWhereEverythingStands) {
  const std::string text =
      "// c \"\n{\"a\": 12 , /* \" */ \"b\\\\\": [1.50,\"x\\\"\\u0041\", -3e2,true,null], \"c\":{\"\":7}}";
  const auto p = parse(text);
  ASSERT_TRUE(p.json) << p.errors;
  const auto at = [&](const TextPosition& position, std::string_view token) {
    EXPECT_EQ(std::string_view(text).substr(position.offset, token.size()), token);
  };
  const Json& j = *p.json;
  at(j.position, "{\"a");
  at(j.members[0].key_position, "\"a\"");
  at(j.members[0].value.position, "12 ,");
  at(j.members[1].key_position, "\"b\\\\\"");
  const Json& b = j.members[1].value;
  at(b.position, "[1.5");
  at(b.items[0].position, "1.50,");
  at(b.items[1].position, "\"x\\\"");
  at(b.items[2].position, "-3e2,");
  at(b.items[3].position, "true");
  at(b.items[4].position, "null");
  at(j.members[2].value.members[0].key_position, "\"\":7");
  at(j.members[2].value.members[0].value.position, "7}");
}

TEST(Json, TakesTopLevelValues) {
  EXPECT_EQ(parse("12").json->position.offset, 0u);
  EXPECT_EQ(parse(" -1.5 ").json->position.offset, 1u);
  EXPECT_EQ(parse("\xEF\xBB\xBF{}").json->position.offset, 3u);
  EXPECT_EQ(parse("18446744073709551615").json->kind, Json::Kind::number);
  EXPECT_EQ(parse("18446744073709551615").json->number, 18446744073709551615.0);
}

TEST(Json, RephrasesSyntaxErrors) {
  EXPECT_EQ(error_of("{\"a\": 1,}"),
            "t:1:9: error: expected a key in quotes, found '}'\n  no comma may follow the last member\n");
  EXPECT_EQ(error_of("{\"a\" 1}"), "t:1:6: error: expected ':' after the key, found '1'\n");
  EXPECT_EQ(error_of("{\"a\": 1\n \"b\": 2}"), "t:2:2: error: expected ',' or '}', found '\"b\"'\n");
  EXPECT_EQ(error_of("[1 2]"), "t:1:4: error: expected ',' or ']', found '2'\n");
  EXPECT_EQ(error_of("[1,]"), "t:1:4: error: expected a value, found ']'\n  no comma may follow the last item\n");
  EXPECT_EQ(error_of("[,1]"), "t:1:2: error: expected a value, found ','\n");
  EXPECT_EQ(error_of("{\"a\": }"), "t:1:7: error: expected a value, found '}'\n");
  EXPECT_EQ(error_of("{a: 1}"), "t:1:2: error: expected a key in quotes, found 'a'\n");
  EXPECT_EQ(error_of("{\"a\": yes}"),
            "t:1:7: error: expected a value, found 'yes'\n"
            "  text stands in double quotes; the only words are true, false and null\n");
  EXPECT_EQ(error_of(""), "t:1:1: error: expected a value, found the end of the file\n");
  EXPECT_EQ(error_of("{\"a\": 1"), "t:1:8: error: expected ',' or '}', found the end of the file\n");
  EXPECT_EQ(error_of("{} {}"), "t:1:4: error: expected the end of the file, found '{'\n");
  EXPECT_EQ(error_of("{\"a\": \"x"), "t:1:7: error: the text has no closing quote\n");
  EXPECT_EQ(error_of("{\"a\": \"x\n\"}"),
            "t:1:7: error: the text holds a line end or control character\n"
            "  write \\n, \\t or \\u00XX within quotes; or is the closing quote missing?\n");
  EXPECT_EQ(error_of("[\"\\q\"]"),
            "t:1:2: error: bad escape in '\"\\q\"'\n  escapes are \\\" \\\\ \\/ \\b \\f \\n \\r \\t and \\uXXXX\n");
  EXPECT_EQ(error_of("[-]"), "t:1:2: error: '-' is no number\n");
  EXPECT_EQ(error_of("[1e999]"), "t:1:2: error: the number '1e999' is too large\n");
  EXPECT_EQ(error_of("[1, /* x ]"), "t:1:5: error: the comment has no closing */\n");
  EXPECT_EQ(error_of("[1, # x\n]"),
            "t:1:5: error: expected a value, found '#'\n"
            "  text stands in double quotes; the only words are true, false and null\n");
  EXPECT_EQ(error_of("[\"\xff\"]"), "t:1:2: error: the text is not UTF-8\n");
}

TEST(Json, ReportsEveryDuplicateKey) {
  EXPECT_EQ(error_of("{\"a\": {\"b\": 1, \"b\": 2},\n \"a\": 3}"),
            "t:1:16: error: a.b: duplicate key 'b'\n  the first is at t:1:8\n"
            "t:2:2: error: a: duplicate key 'a'\n  the first is at t:1:2\n");
}

TEST(Json, BoundsDepth) {
  const std::string deep(64, '['), end(64, ']');
  EXPECT_TRUE(parse(deep + end).json);
  EXPECT_EQ(error_of("[" + deep + end + "]"), "t:1:65: error: nested deeper than 64 levels\n");
}

TEST(Json, HundredMegabytesOfBracketsAreAnError) {
  EXPECT_EQ(error_of(std::string(100 << 20, '[')), "t:1:65: error: nested deeper than 64 levels\n");
  std::string nested;
  for (int i = 0; i < 1000000; ++i) nested += "{\"a\":";
  EXPECT_EQ(error_of(nested), "t:1:321: error: nested deeper than 64 levels\n");
}

TEST(Json, BoundsTheNumberOfValues) {
  std::string many = "[";
  for (int i = 0; i < 4194304; ++i) many += "0,";
  EXPECT_EQ(error_of(many + "0]"), "t:1:8388608: error: more than 4194304 values\n");
}

TEST(Json, BoundsTheNumberOfDuplicateKeys) {
  std::string many = "{\"a\": 0";
  for (int i = 0; i < 1000; ++i) many += ", \"a\": 0";
  const auto messages = error_of(many + "}");
  EXPECT_NE(messages.find("\n  what follows is not read\n"), std::string::npos);
  EXPECT_EQ(std::ranges::count(messages, '\n'), 2 * 64 + 1);
}

TEST(Json, ReadsFilesAndSaysWhyNot) {
  namespace fs = std::filesystem;
  const auto folder = fs::path(testing::TempDir()) / ("quell_json_test_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const auto file = folder / "x.json";
  std::ofstream(file) << "{\"a\": 1}";
  Diagnostics d;
  EXPECT_TRUE(parse_json_file(file.string(), d));
  EXPECT_FALSE(parse_json_file((folder / "absent.json").string(), d));
  EXPECT_FALSE(parse_json_file(folder.string(), d));
  EXPECT_EQ(d.format(), "error: cannot read '" + (folder / "absent.json").string() +
                            "': No such file or directory\nerror: cannot read '" + folder.string() +
                            "': Is a directory\n");
  fs::remove_all(folder);
}

TEST(Json, ShowsValuesShort) {
  const auto p = parse(R"([1, 2.5, "abc", [], [1], {}, {"a":1}, true, null])");
  std::string shown;
  for (const auto& item : p.json->items) shown += item.shown() + " ";
  EXPECT_EQ(shown, "1 2.5 \"abc\" [] [ … ] {} { … } true null ");
  EXPECT_LT(parse('"' + std::string(1000, 'x') + '"').json->shown().size(), 60u);
}

}  // namespace
}  // namespace quell
