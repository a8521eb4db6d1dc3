// The keys of a study, each checked where it stands.
#include "core/lab/study.h"

#include "core/json/members.h"
#include "core/lab/edits.h"
#include "core/lab/variants.h"
#include "core/report/suggest.h"
#include "core/sequence/frame_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

namespace quell {

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> kKeys = {"quell_study",   "name",
                                        "about",         "graph",
                                        "output",        "sequences",
                                        "variants",      "baselines",
                                        "leave_one_out", "each_feedback_level",
                                        "sweeps",        "sweep_separately",
                                        "seeds",         "metrics",
                                        "warm_up"};

bool plain_name(const std::string& name) { return name.find('/') == name.npos && !name.ends_with(".json"); }

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == ".json") names.push_back(it->path().stem().string());
  std::ranges::sort(names);
  return names;
}

class StudyParser {
 public:
  StudyParser(const StudyRequest& request, Diagnostics& diagnostics) : request_(request), diagnostics_(diagnostics) {
    study_.file = request.path;
  }

  std::optional<Study> parse() {
    if (!find_file()) return std::nullopt;
    const auto json = parse_json_file(study_.file, diagnostics_);
    if (!json || !is_document(*json, "quell_study", "a study", diagnostics_)) return std::nullopt;
    const std::size_t before = diagnostics_.errors();
    check_keys(*json, "", kKeys, diagnostics_);
    study_.name = text(*json, "name").value_or(fs::path(study_.file).stem().string());
    study_.about = text(*json, "about").value_or("");
    study_.output = text(*json, "output").value_or("");
    if (const Json* all = list(*json, "sequences", "the sequences that variants are tried on"))
      sequences(*all, "sequences");
    if (const Json* all = list(*json, "metrics", "the metrics that variants are judged by")) metrics(*all);
    seeds(*json);
    warm_up(*json, "");
    if (const auto graph = text(*json, "graph"))
      study_.variants = expand_variants(*json, *graph, folder(), diagnostics_);
    else if (!json->find("graph"))
      error(json->position, "", "a study needs a \"graph\", of which it tries variants");
    if (diagnostics_.errors() != before) return std::nullopt;
    return std::move(study_);
  }

  std::optional<Study> parse(const StudyPart& part) {
    const std::size_t before = diagnostics_.errors();
    study_.output = text(part.json, "output", part.where).value_or("");
    sequences(part.sequences, part.sequences_where);
    for (const auto& m : part.metrics) metric(m);
    warm_up(part.json, part.where);
    if (const auto graph = text(part.json, "graph", part.where))
      study_.variants.push_back({part.name, "", graph_file(*graph, folder()), edits_of(part.json), false,
                                 part.json.find("graph")->position, joined(part.where, "graph")});
    else if (!part.json.find("graph"))
      error(part.json.position, part.where, "has no \"graph\"");
    if (diagnostics_.errors() != before) return std::nullopt;
    return std::move(study_);
  }

 private:
  void error(TextPosition position, std::string path, std::string text, std::vector<std::string> notes = {}) {
    diagnostics_.error(position, std::move(path), std::move(text), std::move(notes));
  }
  fs::path folder() const { return fs::path(study_.file).parent_path(); }
  std::optional<std::string> text(const Json& json, const char* key, const std::string& path = "") {
    return text_member(json, key, path, diagnostics_);
  }

  bool find_file() {
    if (!plain_name(request_.path)) return true;
    const auto studies = request_.graphs / "studies";
    const auto names = names_in(studies);
    if (std::ranges::find(names, request_.path) == names.end()) {
      error({}, "", fmt::format("there is no study '{}'", request_.path),
            {possibilities("installed are", request_.path, names), "a file is named with its folder or with .json"});
      return false;
    }
    study_.file = (studies / (request_.path + ".json")).string();
    return true;
  }

  // The list under a key that must be there and hold something.
  const Json* list(const Json& json, const char* key, const std::string& what) {
    const Json* j = member(json, key, Json::Kind::list, "", diagnostics_);
    if (!json.find(key)) error(json.position, "", fmt::format("a study needs \"{}\": {}", key, what));
    if (j && j->items.empty()) error(j->position, key, fmt::format("is empty; it lists {}", what));
    return j && is_short(*j, key) ? j : nullptr;
  }

  bool is_short(const Json& list, const std::string& path) {
    if (list.items.size() <= kMaxListed) return true;
    error(list.position, path, fmt::format("lists {}; the most are {}", list.items.size(), kMaxListed));
    return false;
  }

  void sequences(const Json& json, const std::string& where) {
    if (!json.is(Json::Kind::list)) return sequence(json, where);
    if (!is_short(json, where)) return;
    for (std::size_t i = 0; i < json.items.size(); ++i) sequence(json.items[i], fmt::format("{}[{}]", where, i));
  }

  void sequence(const Json& json, const std::string& where) {
    StudySequence s;
    s.where = where;
    s.position = json.position;
    if (json.is(Json::Kind::text))
      s.written = json.text;
    else if (json.is(Json::Kind::object))
      sequence_object(json, s);
    else
      error(json.position, s.where, fmt::format("must name a sequence or be an object, not {}", json.shown()));
    if (s.written.empty()) return;
    s.path = sequence_path(s);
    if (s.name.empty()) s.name = fs::path(s.written).stem().string();
    if (const auto why = problem_of_name(s.name); !why.empty()) error(s.position, s.where, why, {"give it a \"name\""});
    const auto same = std::ranges::find(study_.sequences, s.name, &StudySequence::name);
    if (same != study_.sequences.end())
      error(s.position, s.where, fmt::format("two sequences are called '{}'", s.name),
            {fmt::format("the other is {}; give one a \"name\"", same->where)});
    study_.sequences.push_back(std::move(s));
  }

  void sequence_object(const Json& item, StudySequence& s) {
    const std::vector<std::string> keys = {"path", "name", "frames", "root", "source", "reference"};
    check_keys(item, s.where, keys, diagnostics_);
    s.written = text(item, "path", s.where).value_or("");
    if (!item.find("path")) error(item.position, s.where, "has no \"path\": the sequence's name or file");
    s.name = text(item, "name", s.where).value_or("");
    s.frames = text(item, "frames", s.where);
    if (s.frames && s.frames->empty())
      error(item.find("frames")->position, s.where + ".frames", "is empty; leave it out for all frames");
    else if (std::string problem; s.frames && !parse_frame_range(*s.frames, problem))
      error(item.find("frames")->position, s.where + ".frames", problem);
    if (const auto root = text(item, "root", s.where)) s.root = (folder() / *root).lexically_normal().string();
    for (const auto& [key, into] : {std::pair{"source", &s.source}, {"reference", &s.reference}})
      if (const Json* set = member(item, key, Json::Kind::object, s.where, diagnostics_)) *into = set->members;
  }

  // A bare name is a built-in sequence; files lie beside the study.
  std::string sequence_path(const StudySequence& s) {
    if (s.written.find_first_of("/.#@%") != std::string::npos)
      return (folder() / s.written).lexically_normal().string();
    const auto built_in = request_.graphs / "sequences";
    const auto names = names_in(built_in);
    if (std::ranges::find(names, s.written) == names.end())
      error(
          s.position, s.where, fmt::format("there is no sequence '{}'", s.written),
          {possibilities("built in are", s.written, names), "others are files, patterns or folders beside the study"});
    return (built_in / (s.written + ".json")).string();
  }

  void metrics(const Json& all) {
    for (std::size_t i = 0; i < all.items.size(); ++i) {
      const Json& item = all.items[i];
      const auto where = fmt::format("metrics[{}]", i);
      if (!item.is(Json::Kind::text) || item.text.empty()) {
        error(item.position, where, fmt::format("must name a metric, not {}", item.shown()));
        continue;
      }
      if (std::ranges::find(study_.metrics, item.text, &StudyMetric::name) != study_.metrics.end())
        error(item.position, where, fmt::format("'{}' is listed twice", item.text));
      metric({item.text, item.position, where});
    }
  }

  void metric(StudyMetric m) {
    if (!plain_name(m.name) && !m.name.starts_with("quell:")) m.name = (folder() / m.name).lexically_normal().string();
    study_.metrics.push_back(std::move(m));
  }

  void seeds(const Json& json) {
    const Json* j = member(json, "seeds", Json::Kind::object, "", diagnostics_);
    if (!j) return;
    check_keys(*j, "seeds", std::vector<std::string>{"parameter", "values"}, diagnostics_);
    StudySeeds seeds{text(*j, "parameter", "seeds").value_or("seed"), {}, j->position};
    const Json* values = member(*j, "values", Json::Kind::list, "seeds", diagnostics_);
    if (!j->find("values") || (values && values->items.empty()))
      error(values ? values->position : j->position, "seeds", "needs \"values\": the seeds to run with");
    if (!values || !is_short(*values, "seeds.values")) return;
    for (std::size_t i = 0; i < values->items.size(); ++i) {
      const Json& v = values->items[i];
      const std::string where = fmt::format("seeds.values[{}]", i);
      if (!v.is(Json::Kind::integer) || v.integer < 0 || v.integer > std::numeric_limits<int>::max())
        error(v.position, where, fmt::format("must be a whole number of at least 0, not {}", v.shown()));
      else if (std::ranges::find(seeds.values, int(v.integer)) != seeds.values.end())
        error(v.position, where, fmt::format("{} is listed twice", v.integer));
      else
        seeds.values.push_back(int(v.integer));
    }
    study_.seeds = std::move(seeds);
  }

  void warm_up(const Json& json, const std::string& where) {
    const Json* j = json.find("warm_up");
    if (!j) return;
    if (!j->is(Json::Kind::integer) || j->integer < 0 || j->integer > 1'000'000)
      error(j->position, joined(where, "warm_up"), fmt::format("must be a number of frames, not {}", j->shown()));
    else
      study_.warm_up = int(j->integer);
  }

  const StudyRequest& request_;
  Diagnostics& diagnostics_;
  Study study_;
};

}  // namespace

std::optional<Study> load_study(const StudyRequest& request, Diagnostics& diagnostics) {
  return StudyParser(request, diagnostics).parse();
}

std::optional<Study> parse_study(const StudyPart& part, const std::string& file, const fs::path& graphs,
                                 Diagnostics& diagnostics) {
  const StudyRequest request{file, graphs};
  return StudyParser(request, diagnostics).parse(part);
}

}  // namespace quell
