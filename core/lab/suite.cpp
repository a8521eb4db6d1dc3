// The keys of a suite, each checked where it stands.
#include "core/lab/suite.h"

#include "core/json/members.h"
#include "core/lab/variants.h"
#include "core/sequence/frame_range.h"

#include <fmt/format.h>

#include <algorithm>

namespace quell {

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> kTestKeys = {"about",  "graph",    "set",     "swap", "wire",  "bypass",
                                            "output", "sequence", "warm_up", "fail", "golden"};

class SuiteParser {
 public:
  SuiteParser(const std::string& path, const fs::path& graphs, Diagnostics& diagnostics)
      : graphs_(graphs), diagnostics_(diagnostics) {
    suite_.file = path;
  }

  std::optional<Suite> parse() {
    const std::size_t before = diagnostics_.errors();
    const auto json = parse_json_file(suite_.file, diagnostics_);
    if (!json || !is_document(*json, "quell_suite", "a suite", diagnostics_)) return std::nullopt;
    check_keys(*json, "", std::vector<std::string>{"quell_suite", "name", "about", "golden", "tests"}, diagnostics_);
    suite_.name = text(*json, "name", "").value_or(fs::path(suite_.file).stem().string());
    suite_.about = text(*json, "about", "").value_or("");
    golden_ = folder() / text(*json, "golden", "").value_or("golden");
    const Json* tests = member(*json, "tests", Json::Kind::object, "", diagnostics_);
    if (!json->find("tests") || (tests && tests->members.empty()))
      error(json->position, "tests", "a suite needs \"tests\": at least one, by name");
    if (tests && tests->members.size() > kMaxListed)
      error(tests->position, "tests", fmt::format("are {}; the most are {}", tests->members.size(), kMaxListed));
    else if (tests)
      for (const auto& m : tests->members) test(m);
    if (diagnostics_.errors() != before) return std::nullopt;
    return std::move(suite_);
  }

 private:
  void error(TextPosition position, std::string path, std::string text, std::vector<std::string> notes = {}) {
    diagnostics_.error(position, std::move(path), std::move(text), std::move(notes));
  }
  fs::path folder() const { return fs::path(suite_.file).parent_path(); }
  std::optional<std::string> text(const Json& json, const char* key, const std::string& path) {
    return text_member(json, key, path, diagnostics_);
  }

  void test(const JsonMember& m) {
    const std::string where = "tests." + m.key;
    if (const auto why = problem_of_name(m.key); !why.empty()) return error(m.key_position, where, why);
    if (!m.value.is(Json::Kind::object))
      return error(m.value.position, where, fmt::format("must be an object, not {}", m.value.shown()));
    check_keys(m.value, where, kTestKeys, diagnostics_);
    SuiteTest t;
    t.name = m.key, t.position = m.key_position;
    conditions(m.value, where, t);
    golden(m.value, where, t);
    if (t.fail.empty() && !t.golden)
      error(m.key_position, where, "tests nothing; it needs \"golden\" images or conditions to \"fail\" on");
    auto study = study_of(m.value, where, t);
    if (!study) return;
    t.study = std::move(*study);
    suite_.tests.push_back(std::move(t));
  }

  void conditions(const Json& json, const std::string& where, SuiteTest& t) {
    const Json* list = member(json, "fail", Json::Kind::list, where, diagnostics_);
    if (!list) return;
    if (list->items.size() > kMaxListed)
      return error(list->position, where + ".fail",
                   fmt::format("lists {}; the most are {}", list->items.size(), kMaxListed));
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      const Json& item = list->items[i];
      const std::string path = fmt::format("{}.fail[{}]", where, i);
      if (!item.is(Json::Kind::text)) {
        error(item.position, path, fmt::format("must be a condition such as \"flip > 0.05\", not {}", item.shown()));
        continue;
      }
      try {
        t.fail.push_back(parse_threshold(item.text, "the condition"));
      } catch (const Error& e) {
        error(item.position, path, e.what());
      }
    }
  }

  void golden(const Json& json, const std::string& where, SuiteTest& t) {
    const Json* j = member(json, "golden", Json::Kind::object, where, diagnostics_);
    if (!j) return;
    const std::string path = where + ".golden";
    check_keys(*j, path, std::vector<std::string>{"frames", "pixel", "share", "limit"}, diagnostics_);
    GoldenImages images;
    images.pattern = (golden_ / (t.name + ".####.exr")).lexically_normal().string();
    std::string problem = "must be a frame range such as \"7,15\"";
    const auto range = text(*j, "frames", path);
    auto frames = range ? parse_frame_range(*range, problem) : std::nullopt;
    if (frames && frames->size() > kMaxListed)
      problem = fmt::format("names {} frames; the most are {}", frames->size(), kMaxListed), frames.reset();
    if (frames)
      images.frames = std::move(*frames);
    else
      error(j->find("frames") ? j->find("frames")->position : j->position, path + ".frames", problem);
    for (const auto& [key, into] : {std::pair{"pixel", &images.tolerance.pixel},
                                    {"share", &images.tolerance.share},
                                    {"limit", &images.tolerance.limit}}) {
      const Json* value = j->find(key);
      if (!value) continue;
      *into = value->is(Json::Kind::integer) ? double(value->integer) : value->number;
      if ((!value->is(Json::Kind::integer) && !value->is(Json::Kind::number)) || *into < 0 || *into > 1)
        error(value->position, fmt::format("{}.{}", path, key),
              fmt::format("must be a number from 0 to 1, not {}", value->shown()));
    }
    t.golden = std::move(images);
  }

  std::optional<Study> study_of(const Json& json, const std::string& where, const SuiteTest& t) {
    const Json* sequence = json.find("sequence");
    if (!sequence) error(json.position, where, "has no \"sequence\"");
    if (sequence && sequence->is(Json::Kind::list)) {
      error(sequence->position, where + ".sequence", "a test has one sequence, not a list");
      sequence = nullptr;
    }
    if (!sequence) return std::nullopt;
    StudyPart part{json, where, t.name, *sequence, where + ".sequence", {}};
    for (const auto& f : t.fail)
      if (std::ranges::find(part.metrics, f.metric, &StudyMetric::name) == part.metrics.end())
        part.metrics.push_back({f.metric, t.position, where + ".fail"});
    return parse_study(part, suite_.file, graphs_, diagnostics_);
  }

  const fs::path& graphs_;
  Diagnostics& diagnostics_;
  Suite suite_;
  fs::path golden_;
};

}  // namespace

std::optional<Suite> load_suite(const std::string& path, const fs::path& graphs, Diagnostics& diagnostics) {
  return SuiteParser(path, graphs, diagnostics).parse();
}

}  // namespace quell
