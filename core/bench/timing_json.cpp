// Measurements as JSON and back.
#include "core/bench/timing.h"

#include "core/report/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace quell {

namespace {

using nlohmann::ordered_json;

ordered_json json_of(const Spread& s) {
  return {{"median", s.median}, {"minimum", s.minimum}, {"lower_quartile", s.lower}, {"upper_quartile", s.upper}};
}

Spread spread_from(const ordered_json& j) {
  return {j.at("median").get<double>(), j.at("minimum").get<double>(), j.at("lower_quartile").get<double>(),
          j.at("upper_quartile").get<double>()};
}

}  // namespace

std::string timing_json(const Timing& m) {
  ordered_json j;
  j["quell_bench"] = 1;
  j["graph"] = m.graph;
  j["fingerprint"] = m.fingerprint;
  j["input"] = m.input;
  j["width"] = m.width;
  j["height"] = m.height;
  j["frames"] = m.frames;
  j["warmup"] = m.warmup;
  j["threads"] = m.threads;
  j["simd"] = m.simd;
  j["resets"] = m.resets;
  j["ms"] = json_of(m.ms);
  j["cpu_ms"] = json_of(m.cpu_ms);
  j["read_ms"] = m.read_ms;
  j["image_bytes"] = m.image_bytes;
  j["peak_bytes"] = m.peak_bytes;
  auto& nodes = j["nodes"] = ordered_json::array();
  for (const auto& n : m.nodes)
    nodes.push_back({{"name", n.name},
                     {"type", n.type},
                     {"ms", json_of(n.ms)},
                     {"bytes", n.bytes},
                     {"pixels", n.pixels},
                     {"taps", n.taps},
                     {"gigabytes_per_second", n.gigabytes_per_second()},
                     {"megapixels_per_second", n.megapixels_per_second()},
                     {"megataps_per_second", n.megataps_per_second()}});
  return j.dump(2) + "\n";
}

Timing parse_timing(const std::string& path, const std::string& text) {
  try {
    const auto j = ordered_json::parse(text);
    if (const auto version = j.at("quell_bench").get<int>(); version != 1)
      throw Error(Exit::input, fmt::format("{}: quell_bench is {}; this program reads version 1", path, version));
    Timing m;
    m.graph = j.at("graph").get<std::string>(), m.fingerprint = j.at("fingerprint").get<std::string>();
    m.input = j.at("input").get<std::string>();
    m.width = j.at("width").get<int>(), m.height = j.at("height").get<int>();
    m.frames = j.at("frames").get<int>(), m.warmup = j.at("warmup").get<int>();
    m.simd = j.at("simd").get<std::string>();
    m.threads = j.at("threads").get<int>(), m.resets = j.at("resets").get<std::size_t>();
    m.ms = spread_from(j.at("ms")), m.cpu_ms = spread_from(j.at("cpu_ms"));
    m.read_ms = j.at("read_ms").get<double>();
    m.image_bytes = j.at("image_bytes").get<std::size_t>(), m.peak_bytes = j.at("peak_bytes").get<std::size_t>();
    for (const auto& n : j.at("nodes"))
      m.nodes.push_back({n.at("name").get<std::string>(), n.at("type").get<std::string>(), spread_from(n.at("ms")),
                         n.at("bytes").get<std::size_t>(), n.at("pixels").get<std::size_t>(),
                         n.value("taps", std::uint64_t{0})});
    return m;
  } catch (const nlohmann::json::exception& e) {
    throw Error(Exit::input, fmt::format("{}: not a measurement that quell bench --json wrote: {}", path, e.what()));
  }
}

}  // namespace quell
