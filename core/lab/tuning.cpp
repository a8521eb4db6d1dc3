// The keys of a tuning file, each checked where it stands.
#include "core/lab/tuning.h"

#include "core/json/members.h"
#include "core/lab/range.h"
#include "core/lab/threshold.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace quell {

namespace fs = std::filesystem;

namespace {

bool whole(double x) { return x == std::round(x) && std::abs(x) <= std::numeric_limits<int>::max(); }

class TuningParser {
 public:
  TuningParser(const std::string& path, const fs::path& graphs, Diagnostics& diagnostics)
      : graphs_(graphs), diagnostics_(diagnostics) {
    tuning_.file = path;
  }

  std::optional<Tuning> parse() {
    const std::size_t before = diagnostics_.errors();
    const auto json = parse_json_file(tuning_.file, diagnostics_);
    if (!json || !is_document(*json, "quell_tune", "a tuning", diagnostics_)) return std::nullopt;
    const std::vector<std::string> keys = {"quell_tune", "name",        "about",     "graph",      "output",   "set",
                                           "swap",       "wire",        "bypass",    "parameters", "minimise", "train",
                                           "held_out",   "evaluations", "tolerance", "warm_up"};
    check_keys(*json, "", keys, diagnostics_);
    std::ifstream file(tuning_.file);
    std::ostringstream text_of_file;
    text_of_file << file.rdbuf();
    tuning_.text = text_of_file.str();
    tuning_.name = text(*json, "name").value_or(fs::path(tuning_.file).stem().string());
    tuning_.about = text(*json, "about").value_or("");
    minimise(*json);
    parameters(*json);
    limits(*json);
    if (auto study = study_of(*json, "train")) tuning_.training = std::move(*study);
    if (json->find("held_out")) tuning_.held_out = study_of(*json, "held_out");
    if (diagnostics_.errors() != before) return std::nullopt;
    return std::move(tuning_);
  }

 private:
  void error(TextPosition position, std::string path, std::string text, std::vector<std::string> notes = {}) {
    diagnostics_.error(position, std::move(path), std::move(text), std::move(notes));
  }
  std::optional<std::string> text(const Json& json, const char* key) {
    return text_member(json, key, "", diagnostics_);
  }

  void minimise(const Json& json) {
    const Json* j = member(json, "minimise", Json::Kind::text, "", diagnostics_);
    if (!json.find("minimise"))
      error(json.position, "", R"(has no "minimise": what to make small, such as "flicker - psnr_unbiased")");
    if (!j) return;
    try {
      Expression expression(j->text);
      for (const auto& name : expression.names()) {
        const auto metric = parse_statistic(name).metric;
        if (std::ranges::find(metrics_, metric, &StudyMetric::name) == metrics_.end())
          metrics_.push_back({metric, j->position, "minimise"});
      }
      if (metrics_.empty()) return error(j->position, "minimise", "names no metric");
      tuning_.minimise = std::move(expression);
    } catch (const Error& e) {
      error(j->position, "minimise", e.what());
    }
  }

  void parameters(const Json& json) {
    const Json* all = member(json, "parameters", Json::Kind::object, "", diagnostics_);
    if (!json.find("parameters") || (all && all->members.empty()))
      error(json.position, "parameters",
            R"(there are none to tune; as in "parameters": {"alpha": {"from": 0.02, "to": 0.5}})");
    if (all && all->members.size() > kMaxTuned)
      error(all->position, "parameters", fmt::format("are {}; the most are {}", all->members.size(), kMaxTuned));
    else if (all)
      for (const auto& m : all->members) parameter(m);
  }

  void parameter(const JsonMember& m) {
    const std::string path = "parameters." + m.key;
    if (!m.value.is(Json::Kind::object))
      return error(m.value.position, path, fmt::format("must be an object, not {}", m.value.shown()));
    check_keys(m.value, path, std::vector<std::string>{"from", "to", "start", "scale", "integer"}, diagnostics_);
    TunedParameter p{m.key, {}, std::nullopt, m.key_position};
    const auto from = number(m.value, "from", path), to = number(m.value, "to", path);
    for (const auto& [key, there] : {std::pair{"from", bool(from)}, {"to", bool(to)}})
      if (!there && !m.value.find(key)) error(m.value.position, path, fmt::format("has no \"{}\"", key));
    if (const Json* scale = member(m.value, "scale", Json::Kind::text, path, diagnostics_)) {
      p.range.log = scale->text == "log";
      if (scale->text != "log" && scale->text != "linear")
        error(scale->position, path + ".scale", fmt::format("must be linear or log, not {}", scale->shown()));
    }
    if (const Json* integer = member(m.value, "integer", Json::Kind::boolean, path, diagnostics_))
      p.range.integer = integer->boolean;
    if (!from || !to) return;
    p.range.from = *from, p.range.to = *to;
    if (*from >= *to)
      return error(m.value.position, path, fmt::format("its range is empty: from {} to {}", *from, *to));
    if (const auto why = problem_of_range(*from, *to, p.range.log); !why.empty())
      return error(m.value.position, path, why);
    if (p.range.integer && !(whole(*from) && whole(*to)))
      return error(m.value.position, path,
                   fmt::format("a range of whole numbers has such for ends, not {} and {}", *from, *to));
    p.range.start = in_range(*from, *to, p.range.log, 0.5);
    p.start = number(m.value, "start", path);
    if (p.start && (*p.start < *from || *p.start > *to))
      error(m.value.find("start")->position, path + ".start",
            fmt::format("{} is not between {} and {}", *p.start, *from, *to));
    else if (p.start && p.range.integer && !whole(*p.start))
      error(m.value.find("start")->position, path + ".start", fmt::format("{} is not a whole number", *p.start));
    tuning_.parameters.push_back(std::move(p));
  }

  std::optional<double> number(const Json& json, const char* key, const std::string& path) {
    const Json* j = json.find(key);
    if (!j) return std::nullopt;
    if (j->is(Json::Kind::integer)) return double(j->integer);
    if (j->is(Json::Kind::number)) return j->number;
    error(j->position, fmt::format("{}.{}", path, key), fmt::format("must be a number, not {}", j->shown()));
    return std::nullopt;
  }

  void limits(const Json& json) {
    if (const Json* j = json.find("evaluations")) {
      if (!j->is(Json::Kind::integer) || j->integer < 1 || j->integer > 100'000)
        error(j->position, "evaluations", fmt::format("must be a number from 1 to 100000, not {}", j->shown()));
      else
        tuning_.evaluations = int(j->integer);
    }
    if (const auto tolerance = number(json, "tolerance", "")) {
      tuning_.tolerance = *tolerance;
      if (*tolerance < 0 || *tolerance >= 1)
        error(json.find("tolerance")->position, "tolerance",
              fmt::format("is a share of each range, from 0 to below 1, not {}", *tolerance));
    }
  }

  std::optional<Study> study_of(const Json& json, const char* key) {
    const Json* list = member(json, key, Json::Kind::list, "", diagnostics_);
    if (!json.find(key)) error(json.position, "", fmt::format("has no \"{}\": the sequences to tune on", key));
    if (list && list->items.empty()) error(list->position, key, "is empty; it lists the sequences to tune on");
    if (!list || list->items.empty()) return std::nullopt;
    return parse_study({json, "", "base", *list, key, metrics_}, tuning_.file, graphs_, diagnostics_);
  }

  const fs::path& graphs_;
  Diagnostics& diagnostics_;
  Tuning tuning_;
  std::vector<StudyMetric> metrics_;  // of the expression
};

}  // namespace

std::optional<Tuning> load_tuning(const std::string& path, const fs::path& graphs, Diagnostics& diagnostics) {
  return TuningParser(path, graphs, diagnostics).parse();
}

}  // namespace quell
