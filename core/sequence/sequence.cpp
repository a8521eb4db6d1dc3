// From a request to a sequence: a document, a profile that recognises an image, or a profile that recognises a folder.
#include "core/sequence/sequence.h"

#include "core/json/members.h"
#include "core/report/error.h"
#include "core/report/suggest.h"
#include "core/sequence/document.h"
#include "core/sequence/frame_range.h"
#include "core/sequence/image_file.h"
#include "core/sequence/profile.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>

namespace quell {

namespace {

// The least that is said of no files: what was looked for.
[[noreturn]] void no_frames(const std::string& pattern) {
  throw Error(Exit::input, fmt::format("no file is called '{}'", pattern));
}

// Frames that exist of a pattern; throws when there are none. A file without a number is frame 0.
std::vector<std::int64_t> frames_on_disk(const FramePattern& file) {
  std::vector<std::int64_t> frames;
  if (file.numbered()) {
    frames = file.scan();
  } else if (std::filesystem::exists(file.path(0))) {
    frames = {0};
  }
  if (frames.empty()) no_frames(file.text());
  return frames;
}

class Loader {
 public:
  Loader(const SequenceRequest& request, Diagnostics& diagnostics) : request_(request), diagnostics_(diagnostics) {
    sequence_.path = request.path;
  }

  std::optional<Sequence> load() {
    const std::size_t before = diagnostics_.errors();
    read_frames_option();
    if (request_.text || request_.path.ends_with(".json")) {
      document();
    } else if (std::filesystem::is_directory(request_.path)) {
      folder();
    } else {
      images();
    }
    if (diagnostics_.errors() == before) find_frames();
    if (diagnostics_.errors() != before) return std::nullopt;
    return std::move(sequence_);
  }

 private:
  void read_frames_option() {
    if (!request_.frames) return;
    std::string problem;
    if (auto frames = parse_frame_range(*request_.frames, problem)) {
      sequence_.frames = std::move(*frames);
    } else {
      diagnostics_.error({diagnostics_.sources.add("--frames", *request_.frames), 0}, "", problem);
    }
  }

  // ---- A sequence file ----

  void document() {
    const auto json = request_.text ? parse_json(request_.path, *request_.text, diagnostics_)
                                    : parse_json_file(request_.path, diagnostics_, Exit::input);
    if (!json || !is_document(*json, "quell_sequence", "a sequence", diagnostics_)) return;
    const std::vector<std::string> keys = {"quell_sequence", "about", "root",   "frames", "cuts",
                                           "profile",        "file",  "inputs", "source", "reference"};
    check_keys(*json, "", keys, diagnostics_);
    if (const Json* about = member(*json, "about", Json::Kind::text, "", diagnostics_)) sequence_.about = about->text;
    std::filesystem::path root = std::filesystem::path(request_.path).parent_path();
    if (const Json* j = member(*json, "root", Json::Kind::text, "", diagnostics_)) root /= j->text;
    if (request_.root) root = *request_.root;
    sequence_.root = root;
    DocumentContext context{diagnostics_, root};
    frames(*json);
    cuts(*json);
    inputs(*json, context);
    references(*json, context);
    source(*json);
  }

  void frames(const Json& json) {
    const Json* j = json.find("frames");
    if (!j) return;
    std::string problem = fmt::format("must be a frame range such as \"0-19\", not {}", j->shown());
    std::optional<std::vector<std::int64_t>> range;
    if (j->is(Json::Kind::text)) range = parse_frame_range(j->text, problem);
    if (j->is(Json::Kind::integer)) range = {j->integer};
    if (!range) {
      diagnostics_.error(j->position, "frames", problem);
      return;
    }
    declared_ = *range;
    if (!request_.frames) sequence_.frames = std::move(*range);
  }

  void cuts(const Json& json) {
    const Json* list = member(json, "cuts", Json::Kind::list, "", diagnostics_);
    if (!list) return;
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      const Json& item = list->items[i];
      const std::string path = fmt::format("cuts[{}]", i);
      if (!item.is(Json::Kind::integer)) {
        diagnostics_.error(item.position, path, fmt::format("must be a frame number, not {}", item.shown()));
        continue;
      }
      if (!declared_.empty() && std::ranges::find(declared_, item.integer) == declared_.end())
        diagnostics_.error(item.position, path, fmt::format("frame {} is not in the sequence", item.integer),
                           {fmt::format("its frames: {}", frame_range_text(declared_))});
      sequence_.cuts.insert(item.integer);
    }
  }

  void inputs(const Json& json, DocumentContext& context) {
    std::optional<Profile> profile;
    if (const Json* name = member(json, "profile", Json::Kind::text, "", diagnostics_)) {
      const auto known = profile_names(request_.profiles);
      if (std::ranges::find(known, name->text) == known.end()) {
        diagnostics_.error(name->position, "profile", fmt::format("no profile is called '{}'", name->text),
                           {possibilities("there are", name->text, known)});
        return;
      }
      profile = load_profile(request_.profiles, name->text, diagnostics_);
      if (!profile) return;
    }
    const Json* file = member(json, "file", Json::Kind::text, "", diagnostics_);
    const FramePattern pattern(file ? (context.folder / file->text).lexically_normal().string() : "");
    if (file && !profile) profile = recognise(pattern, file->position);
    if (file && profile) take_image_roles(*profile, pattern);
    if (const Json* list = member(json, "inputs", Json::Kind::object, "", diagnostics_)) {
      for (const auto& m : list->members) {
        auto input = parse_input(m.key, m.value, joined("inputs", m.key), false, context);
        if (!input) continue;
        const auto wants_camera = [](const ChannelChoice& c) { return c.conversion.needs_camera(); };
        if (std::ranges::any_of(input->choices, wants_camera)) in_view_.push_back(*input);
        if (profile) overlay(*input, m.value, *profile);
        std::erase_if(sequence_.inputs, [&](const SequenceInput& i) { return i.role == m.key; });
        sequence_.inputs.push_back(std::move(*input));
      }
      // A reference may stand alone: pictures are judged by it.
      if (list->members.empty() && !file && !json.find("reference"))
        diagnostics_.error(list->position, "inputs", "is empty");
    }
    if (json.find("source")) {
      for (const char* key : {"inputs", "file", "profile", "root"})
        if (const Json* j = json.find(key))
          diagnostics_.error(j->position, key, "a sequence has files or a \"source\", not both");
    } else if (!json.find("inputs") && !file) {
      diagnostics_.error(json.position, "", "a sequence needs \"inputs\", a \"file\" or a \"source\"");
    }
    // A profile's choices that need a camera are passed over when there is none; what a document asks for is not.
    const bool camera = std::ranges::any_of(sequence_.inputs, [](const auto& i) { return i.type == QUELL_CAMERA; });
    for (const auto& input : in_view_)
      if (!camera)
        diagnostics_.error(input.position, input.where,
                           "its conversions need the camera's matrices; add a role 'camera'");
  }

  // A document's entry that names no channels takes the profile's, and its conversions unless it has some of its own.
  static void overlay(SequenceInput& input, const Json& entry, const Profile& profile) {
    const auto known = std::ranges::find(profile.inputs, input.role, &SequenceInput::role);
    if (known == profile.inputs.end() || known->type != input.type || entry.find("channels")) return;
    const bool plain = entry.is(Json::Kind::text) || std::ranges::all_of(entry.members, [](const JsonMember& m) {
                         return m.key == "file" || m.key == "type" || m.key == "format";
                       });
    const Conversion own = input.choices.front().conversion;
    input.choices = known->choices;
    for (auto& choice : input.choices) {
      choice.position = input.position;
      if (!plain) choice.conversion = own;
    }
    if (!entry.find("format")) input.format = known->format;
  }

  void references(const Json& json, DocumentContext& context) {
    const Json* j = json.find("reference");
    if (!j) return;
    const auto add = [&](const std::string& role, const Json& value, const std::string& path) {
      if (value.find("source")) {
        check_keys(value, path, std::vector<std::string>{"source"}, diagnostics_);
        if (auto node = source_node(value, path)) sequence_.reference_sources.push_back({role, std::move(*node)});
        return;
      }
      // By its role an entry would have no type; a reference is always radiance.
      auto input = parse_input("color", value, path, false, context);
      if (!input) return;
      input->role = role;
      sequence_.references.push_back(std::move(*input));
    };
    const Json* a = j->find("A");
    const Json* b = j->find("B");
    if (!a && !b) {
      add("reference", *j, "reference");
      return;
    }
    const std::vector<std::string> keys = {"A", "B"};
    check_keys(*j, "reference", keys, diagnostics_);
    if (a) add("reference_a", *a, "reference.A");
    if (b) add("reference_b", *b, "reference.B");
    if (!sequence_.references.empty() && !sequence_.reference_sources.empty())
      diagnostics_.error(j->position, "reference", "one half is made of files and the other by a source node");
    if (!a || !b)
      diagnostics_.error(j->position, "reference",
                         fmt::format("has no \"{}\"; halves of a reference come in pairs", a ? "B" : "A"));
  }

  void source(const Json& json) {
    sequence_.source = source_node(json, "");
    if (sequence_.source && sequence_.frames.empty() && !json.find("frames"))
      diagnostics_.error(json.find("source")->position, "source",
                         "a source makes any frame; say which with \"frames\"");
  }

  // What stands under "source" in an object at `where`.
  std::optional<SourceNode> source_node(const Json& json, const std::string& where) {
    const Json* j = member(json, "source", Json::Kind::object, where, diagnostics_);
    if (!j) return {};
    const std::string path = joined(where, "source");
    check_keys(*j, path, std::vector<std::string>{"type", "set"}, diagnostics_);
    SourceNode node;
    if (const Json* type = member(*j, "type", Json::Kind::text, path, diagnostics_)) {
      node.type = type->text;
      node.position = type->position;
    } else if (!j->find("type")) {
      diagnostics_.error(j->position, path, "has no \"type\": the name of a node that makes frames");
    }
    if (const Json* set = member(*j, "set", Json::Kind::object, path, diagnostics_)) node.set = *set;
    return node;
  }

  // ---- Profiles ----

  // The profile that knows the channels of a pattern's first image.
  std::optional<Profile> recognise(const FramePattern& pattern, TextPosition position) {
    const auto tried = profile_names(request_.profiles);
    const std::string path = first_image(pattern);
    names_ = ImageFile(path).channel_names();
    for (const auto& name : tried) {
      auto profile = load_profile(request_.profiles, name, diagnostics_);
      if (profile && layer_with(names_, profile->channels, profile->layered)) return profile;
    }
    std::vector<std::string> notes = {possibilities("it has", "", names_),
                                      tried.empty()
                                          ? fmt::format("there are no profiles in '{}'", request_.profiles.string())
                                          : fmt::format("profiles tried: {}", fmt::join(tried, ", ")),
                                      "a sequence file can say which channel plays which role"};
    diagnostics_.error(position, "", fmt::format("no profile knows the channels of '{}'", path), std::move(notes));
    return std::nullopt;
  }

  void take_image_roles(const Profile& profile, const FramePattern& pattern) {
    const std::string path = first_image(pattern);
    if (names_.empty()) names_ = ImageFile(path).channel_names();
    for (SequenceInput input : profile.inputs) {
      if (input.format != FileFormat::image) continue;
      std::erase_if(input.choices, [&](const ChannelChoice& c) {
        return !layer_with(names_, c.channels, c.layered) || c.conversion.needs_camera();
      });
      if (input.choices.empty()) continue;
      input.file = pattern;
      sequence_.inputs.push_back(std::move(input));
    }
    if (sequence_.inputs.empty()) {
      diagnostics_.error({}, "", fmt::format("'{}' has no channels that the profile '{}' knows", path, profile.name),
                         {possibilities("it has", "", names_)});
    }
  }

  // Path of the first frame that is there.
  std::string first_image(const FramePattern& pattern) const {
    if (!pattern.numbered()) return pattern.path(0);
    for (const std::int64_t frame : sequence_.frames)
      if (std::filesystem::exists(pattern.path(frame))) return pattern.path(frame);
    return pattern.path(frames_on_disk(pattern).front());
  }

  void images() {
    const FramePattern pattern(request_.path);
    sequence_.root = std::filesystem::path(request_.path).parent_path();
    if (!pattern.numbered() && !std::filesystem::exists(request_.path)) no_frames(request_.path);
    if (const auto profile = recognise(pattern, {})) take_image_roles(*profile, pattern);
  }

  void folder() {
    const std::filesystem::path folder = sequence_.root = request_.path;
    const auto names = profile_names(request_.profiles);
    std::vector<std::string> looked_for;
    for (const auto& name : names) {
      const auto profile = load_profile(request_.profiles, name, diagnostics_);
      if (!profile || profile->files.empty()) continue;
      looked_for.push_back(fmt::format("{} ({})", name, fmt::join(profile->files, ", ")));
      const bool all = std::ranges::all_of(profile->files, [&](const std::string& file) {
        return !FramePattern((folder / file).string()).scan().empty();
      });
      if (!all) continue;
      for (SequenceInput input : profile->inputs) {
        if (input.file.text().empty()) continue;
        input.file = FramePattern((folder / input.file.text()).string());
        const bool there =
            input.file.numbered() ? !input.file.scan().empty() : std::filesystem::exists(input.file.path(0));
        if (there) sequence_.inputs.push_back(std::move(input));
      }
      return;
    }
    diagnostics_.error({}, "", fmt::format("no profile knows the files of the folder '{}'", request_.path),
                       {fmt::format("profiles tried: {}", fmt::join(looked_for, ", ")),
                        "a sequence file can say which file plays which role"});
  }

  // Without a range the frames are those of one input on the disk: of the color, or else of the first with a number.
  void find_frames() {
    if (!sequence_.frames.empty() || sequence_.inputs.empty()) return;
    auto leader = std::ranges::find(sequence_.inputs, "color", &SequenceInput::role);
    const auto numbered = [](const SequenceInput& i) { return i.file.numbered(); };
    if (leader == sequence_.inputs.end() || !numbered(*leader))
      leader = std::ranges::find_if(sequence_.inputs, numbered);
    if (leader == sequence_.inputs.end()) leader = sequence_.inputs.begin();
    sequence_.frames = frames_on_disk(leader->file);
  }

  const SequenceRequest& request_;
  Diagnostics& diagnostics_;
  Sequence sequence_;
  std::vector<std::int64_t> declared_;  // frames of the document
  std::vector<SequenceInput> in_view_;  // of the document, with conversions that need a camera
  std::vector<std::string> names_;      // channels of the image that was recognised
};

}  // namespace

const SequenceInput* Sequence::find(std::string_view role) const {
  for (const auto* list : {&inputs, &references})
    for (const auto& input : *list)
      if (input.role == role) return &input;
  return nullptr;
}

std::map<std::string, int> Sequence::roles() const {
  std::map<std::string, int> out;
  for (const auto* list : {&inputs, &references})
    for (const auto& input : *list) out.emplace(input.role, input.type);
  return out;
}

std::optional<Sequence> load_sequence(const SequenceRequest& request, Diagnostics& diagnostics) {
  return Loader(request, diagnostics).load();
}

}  // namespace quell
