// results.json and results.csv.
#include "core/lab/results.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace quell {

using nlohmann::ordered_json;

namespace {

template <class T>
ordered_json or_null(const std::optional<T>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

ordered_json metric_json(const ResultMetric& m) {
  return {{"name", m.name},
          {"title", m.title},
          {"better", m.higher_is_better ? "higher" : "lower"},
          {"unit", m.unit},
          {"perfect", or_null(m.perfect)}};
}

ordered_json variant_json(const ResultVariant& v) {
  return {{"name", v.name},
          {"about", v.about},
          {"baseline", v.baseline},
          {"edits", ordered_json::parse(v.edits)},
          {"fingerprint", v.fingerprint},
          {"command", v.command},
          {"nodes", v.nodes},
          {"own_nodes", v.own_nodes},
          {"graph", ordered_json::parse(v.graph, nullptr, false)}};
}

ordered_json sequence_json(const Results& r, const ResultSequence& s) {
  return {{"name", s.name}, {"path", s.path}, {"size", {s.width, s.height}}, {"frames", s.frames}, {"seeds", r.seeds}};
}

ordered_json image_json(const Results& r, const ResultImage& i) {
  ordered_json j = {{"kind", i.kind}};
  if (i.variant) j["variant"] = r.variants[*i.variant].name;
  if (i.metric) j["metric"] = r.metrics[*i.metric].name;
  j["sequence"] = r.sequences[i.sequence].name;
  j["frame"] = i.frame;
  j["file"] = i.file;
  return j;
}

ordered_json summary_json(const Results& r, const ResultSummary& s) {
  ordered_json j = {{"variant", r.variants[s.variant].name},
                    {"sequence", s.sequence ? ordered_json(r.sequences[*s.sequence].name) : ordered_json()},
                    {"metric", r.metrics[s.metric].name},
                    {"frames", s.summary.count}};
  const auto add = [&](const char* key, const Summary& of, double value) {
    j[key] = of.count ? ordered_json(value) : ordered_json();
  };
  add("mean", s.summary, s.summary.mean), add("median", s.summary, s.summary.median);
  add("p95", s.summary, s.summary.p95), add("low", s.summary, s.summary.low), add("high", s.summary, s.summary.high);
  add("difference", s.difference, s.difference.mean), add("difference_low", s.difference, s.difference.low);
  add("difference_high", s.difference, s.difference.high);
  return j;
}

// Calls use(variant, sequence, seed, frame, metric, number) for every row.
template <class Use>
void each_row(const Results& r, Use use) {
  for (std::size_t v = 0; v < r.variants.size(); ++v)
    for (std::size_t s = 0; s < r.sequences.size(); ++s)
      for (std::size_t seed = 0; seed < r.seed_count(); ++seed)
        for (std::size_t f = 0; f < r.sequences[s].frames.size(); ++f)
          for (std::size_t m = 0; m < r.metrics.size(); ++m)
            use(r.variants[v].name, r.sequences[s].name, r.seeds.empty() ? std::nullopt : std::optional(r.seeds[seed]),
                r.sequences[s].frames[f], r.metrics[m].name, r.numbers[s][seed][v][f][m]);
}

template <class Item, class Make>
ordered_json list(const std::vector<Item>& items, Make make) {
  auto all = ordered_json::array();
  for (const auto& item : items) all.push_back(make(item));
  return all;
}

}  // namespace

std::string results_json(const Results& r) {
  ordered_json j = {{"quell_results", 1}, {"name", r.name}, {"about", r.about},
                    {"quell", r.version}, {"simd", r.simd}, {"warm_up", r.warm_up}};
  j["metrics"] = list(r.metrics, metric_json);
  j["variants"] = list(r.variants, variant_json);
  j["sequences"] = list(r.sequences, [&](const auto& s) { return sequence_json(r, s); });
  j["images"] = list(r.images, [&](const auto& i) { return image_json(r, i); });
  j["summary"] = list(summaries(r), [&](const auto& s) { return summary_json(r, s); });
  auto& rows = j["rows"] = ordered_json::array();
  each_row(r, [&](const auto& variant, const auto& sequence, const auto& seed, auto frame, const auto& metric,
                  const auto& number) {
    rows.push_back({{"variant", variant},
                    {"sequence", sequence},
                    {"seed", or_null(seed)},
                    {"frame", frame},
                    {"metric", metric},
                    {"value", or_null(number)}});
  });
  // A line for each row and the like: large, but for eyes and for diff.
  std::string text = "{\n";
  for (auto it = j.begin(); it != j.end(); ++it) {
    text += fmt::format("  {}: ", ordered_json(it.key()).dump());
    if (it->is_array() && !it->empty()) {
      text += "[\n";
      for (std::size_t i = 0; i < it->size(); ++i)
        text += fmt::format("    {}{}\n", (*it)[i].dump(), i + 1 < it->size() ? "," : "");
      text += "  ]";
    } else {
      text += it->dump();
    }
    text += std::next(it) == j.end() ? "\n" : ",\n";
  }
  return text + "}\n";
}

std::string results_csv(const Results& r) {
  std::string text = "variant,sequence,seed,frame,metric,value\n";
  // Names hold commas where a sweep crosses two parameters, and anything where they are those of files (RFC 4180).
  const auto quoted = [](const std::string& name) {
    if (name.find_first_of(",\"\r\n") == name.npos) return name;
    std::string text = "\"";
    for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
    return text + "\"";
  };
  each_row(r, [&](const auto& variant, const auto& sequence, const auto& seed, auto frame, const auto& metric,
                  const auto& number) {
    text += fmt::format("{},{},{},{},{},{}\n", quoted(variant), quoted(sequence),
                        seed ? std::to_string(*seed) : std::string(), frame, metric,
                        number ? ordered_json(*number).dump() : std::string());
  });
  return text;
}

}  // namespace quell
