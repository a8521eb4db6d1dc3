// The judged image is a role of the frames, which the smallest graph there is passes on.
#include "tests/support/judge.h"

#include "core/lab/metric.h"
#include "core/run/executor.h"
#include "tests/support/paths.h"
#include "tests/support/run_node.h"

#include <quell/types.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace quell::test {

namespace {

constexpr const char* kPass = R"({ "quell": 1, "inputs": { "judged": "radiance" }, "outputs": { "color": "judged" } })";

void copy(const quell_image& from, const quell_image& to) {
  for (int c = 0; c < from.channels; ++c)
    for (int y = 0; y < from.height; ++y)
      std::copy_n(from.plane[c] + y * from.pitch, from.width, to.plane[c] + y * to.pitch);
}

class MadeFrames : public FrameSource {
 public:
  explicit MadeFrames(const std::vector<JudgedFrame>& frames) : made_(frames) {
    for (const auto& [name, input] : frames.at(0)) roles_[role_of(name)] = input.type;
    for (std::size_t i = 0; i < frames.size(); ++i) frames_.push_back(std::int64_t(i));
  }
  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t frame) const override { return frame == 0; }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t frame, std::span<const std::string> roles) override {
    std::vector<quell_shape> shapes;
    for (const auto& role : roles) shapes.push_back(image(frame, role).shape());
    return shapes;
  }
  void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) override {
    for (std::size_t i = 0; i < roles.size(); ++i) copy(image(frame, roles[i]).view(), into[i]);
  }
  std::map<std::string, Repairs> repairs() const override { return {}; }

 private:
  static std::string role_of(const std::string& name) { return name == kJudged ? "judged" : name; }
  const Image& image(std::int64_t frame, const std::string& role) const {
    return *made_[std::size_t(frame)].at(role == "judged" ? std::string(kJudged) : role).image;
  }

  const std::vector<JudgedFrame>& made_;
  std::map<std::string, int> roles_;
  std::vector<std::int64_t> frames_;
};

class KeepVerdicts : public FrameSink {
 public:
  explicit KeepVerdicts(const Graph& graph) : graph_(graph) {}
  void write(std::int64_t, std::span<const quell_image> outputs) override {
    auto& verdict = verdicts.emplace_back();
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const auto& name = graph_.outputs[i].name;
      if (name == "m.value") verdict.value = outputs[i].plane[0][0];
      if (name == "m.pixels") verdict.pixels = outputs[i].plane[0][0];
      if (name != "m.map") continue;
      verdict.map = Image(outputs[i].width, outputs[i].height, outputs[i].channels);
      copy(outputs[i], verdict.map.view());
    }
  }
  std::vector<Verdict> verdicts;

 private:
  const Graph& graph_;
};

}  // namespace

std::vector<Verdict> judge(const std::string& metric, const std::vector<JudgedFrame>& frames, std::vector<Edit> edits) {
  MadeFrames source(frames);
  GraphRequest request;
  request.graph = "judged.json";
  request.text = kPass;
  request.graphs = std::filesystem::path(QUELL_TEST_SOURCE) / "graphs";
  Diagnostics diagnostics;
  auto graph = load_graph(request, registry(), diagnostics);
  std::map<std::string, int> roles{{std::string(kJudged), QUELL_RADIANCE}};
  roles.insert(source.roles().begin(), source.roles().end());
  const auto loaded = load_metric(metric, request.graphs, registry(), diagnostics, roles, std::move(edits));
  if (!graph || !loaded || !diagnostics.format().empty()) throw std::runtime_error(diagnostics.format());
  attach_metric(*graph, 0, *loaded, "m");
  KeepVerdicts sink(*graph);
  run_graph(*graph, source, sink, {});
  return std::move(sink.verdicts);
}

Verdict judge(const std::string& metric, const Image& image, const Image& reference, std::vector<Edit> edits) {
  auto verdicts = judge(metric, {{{"image", {QUELL_RADIANCE, &image}}, {"reference", {QUELL_RADIANCE, &reference}}}},
                        std::move(edits));
  return std::move(verdicts.at(0));
}

Verdict judge(const std::string& metric, const Image& image, const Image& a, const Image& b) {
  auto verdicts = judge(metric, {{{"image", {QUELL_RADIANCE, &image}},
                                  {"reference_a", {QUELL_RADIANCE, &a}},
                                  {"reference_b", {QUELL_RADIANCE, &b}}}});
  return std::move(verdicts.at(0));
}

}  // namespace quell::test
