#include "core/lab/report.h"

#include "core/lab/report_page.h"
#include "core/sequence/temporary_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <stdexcept>
#include <string_view>

namespace quell {

namespace {

using nlohmann::json;

const char* name_of(ReportImage::Kind kind) {
  switch (kind) {
    case ReportImage::Kind::reference:
      return "reference";
    case ReportImage::Kind::input:
      return "input";
    case ReportImage::Kind::map:
      return "map";
    default:
      return "image";
  }
}

// JSON inside HTML: < stands in texts only, and there may be written as its code, so that no text ends the element.
std::string inside_html(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text)
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  return out;
}

std::string data_element(const char* id, const std::string& text, const char* type = "application/json") {
  return fmt::format("<script type=\"{}\" id=\"{}\">{}</script>\n", type, id, text);
}

void require_json(const char* what, const std::string& text) {
  if (!json::accept(text)) throw std::invalid_argument(fmt::format("the text of {} is no JSON", what));
}

// What an error map's colours should span: all but the lowest and highest hundredth, so that single pixels do not
// darken the rest.
struct Span {
  float low, high;
};

Span span_of(const HalfImage& image) {
  std::vector<float> values;
  values.reserve(image.halves.size());
  for (const auto bits : image.halves)
    if (const float value = glm::unpackHalf1x16(bits); std::isfinite(value)) values.push_back(value);
  if (values.empty()) return {0, 0};
  const auto at = [&](double share) {
    const auto place = values.begin() + std::ptrdiff_t(double(values.size() - 1) * share);
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  return {at(0.01), at(0.99)};
}

class Page {
 public:
  explicit Page(const std::string& path) : file_(path) {}

  void write(std::string_view text) {
    file_.write(text.data(), text.size());
    size_.bytes += text.size();
  }

  // Writes the image and returns what the page must know of it.
  json write(const ReportImage& entry, std::size_t index) {
    const HalfImage image = entry.read();
    const std::string id = fmt::format("image-{}", index), text = packed_image(image);
    write(data_element(id.c_str(), text, "text/plain"));
    size_.image_bytes += text.size();
    size_.image_halves += 2 * image.halves.size();
    json known = {{"id", id},
                  {"kind", name_of(entry.kind)},
                  {"variant", entry.variant},
                  {"sequence", entry.sequence},
                  {"frame", entry.frame},
                  {"metric", entry.metric},
                  {"width", image.width},
                  {"height", image.height},
                  {"planes", image.planes},
                  {"bytes", text.size()}};
    if (entry.kind == ReportImage::Kind::map) {
      const Span span = span_of(image);
      known["low"] = span.low;
      known["high"] = span.high;
    }
    return known;
  }

  ReportSize finish() {
    file_.commit();
    return size_;
  }

 private:
  TemporaryFile file_;
  ReportSize size_;
};

std::vector<std::uint8_t> bytes_of_hex(std::string_view hex) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(std::uint8_t(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16)));
  return bytes;
}

// Nothing may be loaded from anywhere, and of styles and scripts nothing runs but the page's own.
std::string policy() {
  const auto hash = [](const char* hex) { return "'sha256-" + base64(bytes_of_hex(hex)) + "'"; };
  return fmt::format("default-src 'none'; style-src {}; script-src {}; base-uri 'none'; form-action 'none'",
                     hash(kReportStyleHash), hash(kReportScriptHash));
}

}  // namespace

ReportSize write_report_html(const std::string& path, const Report& report) {
  const std::string timings = report.timings.empty() ? "null" : report.timings;
  require_json("results.json", report.results);
  require_json("timings.json", timings);

  Page page(path);
  // The template's marks, in the order in which it has them.
  std::string_view rest = kReportPage;
  const auto up_to = [&](std::string_view mark) {
    const auto at = rest.find(mark);
    page.write(rest.substr(0, at));
    rest.remove_prefix(at + mark.size());
  };
  up_to("@POLICY@");
  page.write(policy());
  up_to("@STYLE@");
  page.write(kReportStyle);
  up_to("@DATA@");
  page.write(data_element("results", inside_html(report.results)));
  page.write(data_element("timings", inside_html(timings)));
  json parts = {{"images", json::array()}, {"graphs", json::array()}};
  for (const auto& image : report.images) parts["images"].push_back(page.write(image, parts["images"].size()));
  for (const auto& g : report.graphs)
    parts["graphs"].push_back({{"variant", g.variant}, {"svg", g.svg}, {"changed", g.changed}, {"removed", g.removed}});
  page.write(data_element("parts", inside_html(parts.dump())));
  up_to("@SCRIPT@");
  page.write(kReportScript);
  page.write(rest);
  return page.finish();
}

}  // namespace quell
