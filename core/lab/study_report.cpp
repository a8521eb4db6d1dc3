// What the report shows of a study.
#include "core/lab/study_report.h"

#include "core/graph/draw.h"
#include "core/sequence/image_file.h"
#include "core/sequence/image_writer.h"

#include <Imath/half.h>
#include <quell/types.h>

#include <fmt/format.h>

#include <map>
#include <sstream>

namespace quell {

namespace {

// Of a file that was written as halves, so that nothing is rounded.
HalfImage read_halves(const std::string& path, int type) {
  ImageFile file(path);
  const auto names = channel_names(type, type == QUELL_RADIANCE ? 3 : 1);
  const auto size = file.size(file.find(names[0]));
  HalfImage image{size.width, size.height, int(names.size()), {}};
  const std::size_t pixels = std::size_t(size.width) * std::size_t(size.height);
  std::vector<float> planes(pixels * names.size());
  std::vector<ChannelRead> reads;
  for (std::size_t c = 0; c < names.size(); ++c) reads.push_back({file.find(names[c]), planes.data() + c * pixels});
  file.read(reads, size.width);
  for (const float value : planes) image.halves.push_back(half(value).bits());
  return image;
}

// What each node is and reads, by its name.
std::map<std::string, std::string> nodes_of(const Graph& graph) {
  std::map<std::string, std::string> nodes;
  std::istringstream lines(fingerprint_text(graph));
  std::string* node = nullptr;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("node ")) node = &nodes[line.substr(5, line.find(' ', 5) - 5)];
    if (node && (line.starts_with("node ") || line.starts_with("  "))) *node += line + "\n";
  }
  return nodes;
}

ReportGraph graph_of(const StudyVariant& variant, const Graph& graph, const Graph& base) {
  ReportGraph out{variant.name, draw_svg(graph), {}, {}};
  if (variant.baseline) return out;
  const auto own = nodes_of(graph), before = nodes_of(base);
  for (const auto& [name, text] : own)
    if (const auto it = before.find(name); it == before.end() || it->second != text) out.changed.push_back(name);
  for (const auto& [name, text] : before)
    if (!own.contains(name)) out.removed.push_back(name);
  return out;
}

}  // namespace

Report study_report(const Study& study, const Trial& trial, const Results& results, const std::string& timings,
                    const std::filesystem::path& folder) {
  Report report{results_json(results), timings, {}, {}};
  for (const auto& image : results.images) {
    const auto kind = image.kind == "output"      ? ReportImage::Kind::image
                      : image.kind == "reference" ? ReportImage::Kind::reference
                      : image.kind == "input"     ? ReportImage::Kind::input
                                                  : ReportImage::Kind::map;
    const int type = kind == ReportImage::Kind::map ? QUELL_SCALAR : QUELL_RADIANCE;
    report.images.push_back({kind, image.variant ? results.variants[*image.variant].name : "",
                             results.sequences[image.sequence].name, int(image.frame),
                             image.metric ? results.metrics[*image.metric].name : "",
                             [path = (folder / image.file).string(), type] { return read_halves(path, type); }});
  }
  for (std::size_t v = 0; v < study.variants.size(); ++v)
    report.graphs.push_back(graph_of(study.variants[v], trial.variants()[v].plain, trial.variants()[0].plain));
  return report;
}

}  // namespace quell
