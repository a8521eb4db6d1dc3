// A picture may come from anybody: every attribute is checked before it is used.
#include "apps/quell/recorded.h"

#include "core/json/json.h"
#include "core/report/error.h"
#include "core/sequence/frame_range.h"
#include "core/sequence/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace quell {

namespace {

constexpr std::size_t kLargestText = std::size_t(1) << 26;

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path), texts_(ImageFile(path).texts()) {
    if (!texts_.contains("quell:graph") || !texts_.contains("quell:frames"))
      throw Error(Exit::usage,
                  fmt::format("{}: does not say how it was made, so it cannot be made again\n  'quell run' "
                              "writes that into its images",
                              path_));
  }

  Recorded read() {
    Recorded r;
    r.version = text("quell:version"), r.simd = text("quell:simd"), r.plugins = text("quell:plugins");
    r.graph = text("quell:graph"), r.fingerprint = text("quell:fingerprint"), r.sequence = text("quell:sequence");
    if (r.sequence.empty()) damaged("quell:sequence", "is empty: these frames came from no sequence that can be said");
    if (texts_.contains("quell:missing")) r.missing = text("quell:missing");
    frames(r);
    inputs(r);
    state(r);
    output(r);
    return r;
  }

 private:
  [[noreturn]] void damaged(const std::string& key, const std::string& why) const {
    throw Error(Exit::usage, fmt::format("{}: its attribute '{}' {}", path_, key, why));
  }

  const std::string& text(const std::string& key) const {
    const auto it = texts_.find(key);
    if (it == texts_.end()) damaged(key, "is missing");
    if (it->second.size() > kLargestText)
      damaged(key, fmt::format("has {} bytes; at most {} are read", it->second.size(), kLargestText));
    return it->second;
  }

  Json json(const std::string& key, Json::Kind kind) const {
    Diagnostics diagnostics;
    auto json = parse_json(fmt::format("{} ({})", path_, key), text(key), diagnostics);
    if (!json) throw Error(Exit::usage, diagnostics.list().empty() ? path_ : trimmed(diagnostics.format()));
    if (json->kind != kind) damaged(key, fmt::format("is {}", json->shown()));
    return std::move(*json);
  }
  static std::string trimmed(std::string text) {
    while (text.ends_with('\n')) text.pop_back();
    return text;
  }

  std::string member(const Json& object, const char* name, const std::string& key) const {
    const Json* j = object.find(name);
    if (!j || !j->is(Json::Kind::text)) damaged(key, fmt::format("has no text \"{}\"", name));
    return j->text;
  }

  void frames(Recorded& r) const {
    std::string problem;
    const auto range = parse_frame_range(text("quell:frames"), problem);
    if (!range) damaged("quell:frames", fmt::format("is no range: {}", problem));
    r.first = range->front(), r.frame = range->back();
    if (r.frame - r.first + 1 != std::int64_t(range->size()))
      damaged("quell:frames", fmt::format("is '{}', which has gaps", text("quell:frames")));
  }

  void inputs(Recorded& r) const {
    for (const auto& m : json("quell:inputs", Json::Kind::object).members) {
      if (!m.value.is(Json::Kind::text)) damaged("quell:inputs", fmt::format("has {} for a hash", m.value.shown()));
      r.inputs[m.key] = m.value.text;
    }
    if (texts_.contains("quell:history")) {
      std::istringstream words(text("quell:history"));
      for (std::string word; words >> word;) r.history.push_back(word);
    }
    if (texts_.contains("quell:files"))
      for (const auto& item : json("quell:files", Json::Kind::list).items) {
        if (!item.is(Json::Kind::text)) damaged("quell:files", fmt::format("holds {}", item.shown()));
        r.files.push_back(item.text);
      }
  }

  void state(Recorded& r) const {
    if (!texts_.contains("quell:state")) return;
    const Json j = json("quell:state", Json::Kind::object);
    r.state = member(j, "file", "quell:state"), r.state_hash = member(j, "hash", "quell:state");
  }

  void output(Recorded& r) const {
    const std::string key = "quell:output";
    const Json j = json(key, Json::Kind::object);
    r.output = member(j, "name", key);
    if (const auto* shown = j.find("preview_of"))
      throw Error(Exit::usage,
                  fmt::format("{}: is a preview of '{}'; give the image that it was made beside", path_, shown->text));
    if (j.find("tap")) r.tap = member(j, "tap", key);
    const Json* half = j.find("half");
    if (!half || !half->is(Json::Kind::boolean)) damaged(key, "has no \"half\"");
    r.options.half = half->boolean;
    std::string name = member(j, "compression", key);
    if (const Json* level = j.find("level"); level && level->is(Json::Kind::integer))
      name += fmt::format(":{}", level->integer);
    const auto compression = parse_exr_compression(name);
    if (!compression) damaged(key, fmt::format("names the compression '{}', which there is not", name));
    r.options.compression = *compression;
  }

  std::string path_;
  Texts texts_;
};

}  // namespace

Recorded read_recorded(const std::string& path) { return Reader(path).read(); }

}  // namespace quell
