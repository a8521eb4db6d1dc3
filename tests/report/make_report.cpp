// Writes a report of a study that never ran, whose every number and pixel is known: make_report FOLDER SVG leaves
// report.html, results.json, timings.json, and images.json and images.bin with what the images must decode to.
#include "core/lab/report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <glm/gtc/packing.hpp>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace {

using nlohmann::json;
using quell::HalfImage;
using quell::ReportImage;

constexpr int kFrames = 16, kFirst = 5, kWarmUp = 4;

struct Sequence {
  const char* name;
  int width, height;
};
constexpr Sequence kSequences[] = {{"room", 64, 36}, {"dark hall", 50, 41}};

// Names and texts hold what ends elements, attributes and JSON when it is not escaped.
struct Variant {
  const char *name, *about, *edits, *changed;
  double error, cost;
};
const std::vector<Variant> kVariants = {
    {"svgf", "the base", R"({})", "", 0.021, 9.31},
    {"no_variance", "without the estimate of variance", R"({"bypass": ["level0.by_luminance"]})", "level0.by_luminance",
     0.034, 7.9},
    {"no_feedback", "history is not filtered", R"({"wire": {"history.image": "blend"}})", "history", 0.018, 9.28},
    {"first_level", "feedback of the first level", R"({"wire": {"history.image": "level1.atrous"}})", "history", 0.0205,
     9.33},
    {"alpha_0.05", "slower", R"({"set": {"alpha": 0.05}})", "blend", 0.0192, 9.3},
    {"alpha_0.5", "faster", R"({"set": {"alpha": 0.5}})", "blend", 0.048, 9.3},
    {"three_levels", "two levels fewer", R"({"bypass": ["level3.atrous", "level4.atrous"]})", "level2.atrous", 0.041,
     6.12},
    {"no_normals", "edges of normals are not kept", R"({"bypass": ["level0.by_normal"]})", "level0.by_normal", 0.087,
     8.4},
    {"no_history", "each frame alone", R"({"set": {"alpha": 1}})", "blend", 0.11, 4.02},
    {"a<b & \"c\"", "</script><script>document.title = 'taken over'</script>", R"({"set": {"name": "</script>"}})",
     "blend", 0.06, 9.0},
    {"gaussian", "a baseline", R"({})", "", 0.31, 1.204},
    {"unfiltered", "a baseline", R"({})", "", 2.4, 0.113},
};

std::mt19937 generator(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  std::seed_seq seed{a, b, c};
  return std::mt19937(seed);
}

// A floor of squares, a wall that darkens, a lamp far above white and a ball that moves with the frame; noise on top.
HalfImage picture(const Sequence& s, int frame, double noise, std::mt19937& random) {
  HalfImage image{s.width, s.height, 3, {}};
  std::normal_distribution<double> normal;
  for (int c = 0; c < 3; ++c)
    for (int y = 0; y < s.height; ++y)
      for (int x = 0; x < s.width; ++x) {
        const double u = (x + 0.5) / s.width, v = (y + 0.5) / s.height;
        double light = v > 0.6 ? ((x * 12 / s.width + y * 8 / s.height) % 2 ? 0.5 : 0.12) : 0.7 - 0.5 * u;
        if (std::hypot(u - 0.75, v - 0.2) < 0.08) light = 12;
        if (std::hypot(u - 0.2 - 0.03 * frame, (v - 0.55) * 0.6) < 0.12) light = c == 0 ? 0.8 : 0.1;
        const double value = light * (1 + 0.1 * c) * std::max(0.0, 1 + noise * normal(random));
        image.halves.push_back(glm::packHalf1x16(float(value)));
      }
  // Halves of every exponent and both signs in the first row.
  for (int c = 0; c < 3; ++c)
    for (int x = 0; x < s.width; ++x) {
      const auto bits = std::uint16_t(random());
      image.halves[std::size_t((c * s.height) * s.width + x)] = (bits & 0x7c00) == 0x7c00 ? 0x7bff : bits;
    }
  return image;
}

HalfImage map(const Sequence& s, double error, std::mt19937& random) {
  HalfImage image{s.width, s.height, 1, {}};
  std::exponential_distribution<double> spread;
  for (int i = 0; i < s.width * s.height; ++i) image.halves.push_back(glm::packHalf1x16(float(error * spread(random))));
  return image;
}

json results_json() {
  json r = {{"quell_results", 1},
            {"name", "Parts of SVGF"},
            {"about", "What each part of SVGF buys, and what two baselines leave."},
            {"quell", "0.1.0"},
            {"simd", "avx2"},
            {"warm_up", kWarmUp},
            {"variants", json::array()},
            {"sequences", json::array()},
            {"rows", json::array()},
            {"summary", json::array()}};
  r["metrics"] = json::parse(R"([
    {"name": "relmse", "title": "relMSE", "better": "lower", "unit": "", "perfect": 0},
    {"name": "psnr_unbiased", "title": "PSNR*", "better": "higher", "unit": "dB", "perfect": null},
    {"name": "flicker", "title": "Flicker", "better": "lower", "unit": "", "perfect": 0}])");
  for (const auto& v : kVariants)
    r["variants"].push_back({{"name", v.name},
                             {"about", v.about},
                             {"edits", json::parse(v.edits)},
                             {"fingerprint", "0123456789abcdef"},
                             {"command", fmt::format("quell run svgf room --set 'name={}' -o out.exr", v.name)},
                             {"nodes", 20 + int(std::string(v.name).size())},
                             {"own_nodes", 3}});
  for (const auto& s : kSequences) {
    json frames = json::array();
    for (int f = 0; f < kFrames; ++f) frames.push_back(kFirst + f);
    r["sequences"].push_back(
        {{"name", s.name}, {"path", "room"}, {"size", {s.width, s.height}}, {"frames", frames}, {"seeds", {1, 2}}});
  }
  auto random = generator(1, 2, 3);
  std::normal_distribution<double> normal(0, 0.05);
  std::vector<double> of_first;  // means of the first variant, in the order of its summaries
  for (std::size_t v = 0; v < kVariants.size(); ++v)
    for (std::size_t m = 0, place = 0; m < r["metrics"].size(); ++m) {
      std::vector<double> all;
      const auto summarise = [&](const json& sequence, std::vector<double> values) {
        std::sort(values.begin(), values.end());
        double mean = 0;
        for (const double value : values) mean += value / double(values.size());
        if (v == 0) of_first.push_back(mean);
        const double difference = mean - of_first[place++];
        r["summary"].push_back({{"variant", kVariants[v].name},
                                {"sequence", sequence},
                                {"metric", r["metrics"][m]["name"]},
                                {"mean", mean},
                                {"median", values[values.size() / 2]},
                                {"p95", values[values.size() * 95 / 100]},
                                {"low", mean - 0.02 * std::abs(mean)},
                                {"high", mean + 0.02 * std::abs(mean)},
                                {"difference", difference},
                                {"difference_low", difference - 0.06 * std::abs(mean)},
                                {"difference_high", difference + 0.06 * std::abs(mean)},
                                {"frames", values.size()}});
      };
      for (const auto& s : kSequences) {
        std::vector<double> values;
        for (const int seed : {1, 2})
          for (int f = 0; f < kFrames; ++f) {
            const double error = kVariants[v].error * (1 + 3.0 / (1 + f)) * (1 + normal(random));
            const double value = m == 0 ? error : m == 1 ? -10 * std::log10(error) : 40 * error;
            const bool none = m == 2 && f == 0;
            r["rows"].push_back({{"variant", kVariants[v].name},
                                 {"sequence", s.name},
                                 {"seed", seed},
                                 {"frame", kFirst + f},
                                 {"metric", r["metrics"][m]["name"]},
                                 {"value", none ? json(nullptr) : json(value)}});
            if (f >= kWarmUp) values.push_back(value);
          }
        summarise(s.name, values);
        all.insert(all.end(), values.begin(), values.end());
      }
      summarise(nullptr, all);
    }
  return r;
}

json timings_json() {
  json t = {{"quell_timings", 1}, {"variants", json::array()}};
  for (const auto& v : kVariants) {
    auto& variant = t["variants"].emplace_back(json{{"name", v.name}, {"cost_ms", v.cost}});
    for (const auto& s : kSequences) variant["cost_ms_of"][s.name] = v.cost;
  }
  return t;
}

class Folder {
 public:
  explicit Folder(std::filesystem::path path) : path_(std::move(path)) {
    std::filesystem::create_directories(path_);
    raw_.open(path_ / "images.bin", std::ios::binary);
    raw_.exceptions(std::ios::failbit | std::ios::badbit);
  }

  void write(const char* name, const std::string& text) { std::ofstream(path_ / name) << text; }

  // An entry of the report, and of the list of what it must decode to.
  ReportImage entry(ReportImage::Kind kind, const char* variant, const Sequence& s, int frame, const char* metric,
                    const HalfImage& image) {
    index_.push_back({{"kind", int(kind)},
                      {"variant", variant},
                      {"sequence", s.name},
                      {"frame", frame},
                      {"width", image.width},
                      {"height", image.height},
                      {"planes", image.planes},
                      {"offset", std::size_t(raw_.tellp())}});
    raw_.write(reinterpret_cast<const char*>(image.halves.data()), std::streamsize(2 * image.halves.size()));
    return {kind, variant, s.name, frame, metric, [image] { return image; }};
  }

  void finish() {
    raw_.close();
    write("images.json", index_.dump());
  }

  std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
  std::ofstream raw_;
  json index_ = json::array();
};

void make(const char* target, const char* drawing) {
  Folder folder(target);
  quell::Report report;
  report.results = results_json().dump(1);
  report.timings = timings_json().dump(1);
  folder.write("results.json", report.results);
  folder.write("timings.json", report.timings);
  using Kind = ReportImage::Kind;
  for (std::uint32_t s = 0; s < std::size(kSequences); ++s)
    for (int f = 0; f < kFrames; ++f) {
      const auto& sequence = kSequences[s];
      const int frame = kFirst + f;
      auto random = generator(s, std::uint32_t(f), 0);
      const auto add = [&](Kind kind, const char* variant, const char* metric, const HalfImage& image) {
        report.images.push_back(folder.entry(kind, variant, sequence, frame, metric, image));
      };
      add(Kind::input, "", "", picture(sequence, f, 1, random));
      // As with references that take long: not of every frame.
      if (f % 3 == 0) add(Kind::reference, "", "", picture(sequence, f, 0, random));
      for (const auto& v : kVariants) {
        add(Kind::image, v.name, "", picture(sequence, f, std::sqrt(v.error) / 2, random));
        add(Kind::map, v.name, "relmse", map(sequence, v.error, random));
      }
    }
  std::ifstream in(drawing);
  const std::string svg{std::istreambuf_iterator<char>(in), {}};
  for (const auto& v : kVariants) {
    quell::ReportGraph graph{v.name, svg, {}, {}};
    if (*v.changed) graph.changed.push_back(v.changed);
    if (std::string(v.name) == "three_levels") graph.removed = {"level9.atrous"};
    report.graphs.push_back(graph);
  }
  folder.finish();
  const auto size = write_report_html(folder.file("report.html"), report);
  fmt::print("{} bytes, of them {} for images of {} bytes of halves\n", size.bytes, size.image_bytes,
             size.image_halves);
}

}  // namespace

int main(int count, char** arguments) try {
  if (count != 3) {
    fmt::print(stderr, "make_report FOLDER SVG\n");
    return 2;
  }
  make(arguments[1], arguments[2]);
  return 0;
} catch (const std::exception& e) {
  fmt::print(stderr, "make_report: {}\n", e.what());
  return 1;
}
