// Opens sequences of files and reads their frames: every file once a frame, all its roles together.
#include "core/sequence/file_sequence.h"

#include "core/image/image.h"
#include "core/report/error.h"
#include "core/report/suggest.h"
#include "core/sequence/channels.h"
#include "core/sequence/file_hash.h"
#include "core/sequence/frame_range.h"
#include "core/sequence/sequence.h"
#include "core/sequence/write.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <unordered_map>

namespace quell {

std::optional<Missing> missing_from_name(std::string_view name) {
  for (std::size_t i = 0; i < std::size(kMissingNames); ++i)
    if (kMissingNames[i] == name) return Missing(i);
  return std::nullopt;
}

namespace {

// An input whose channels are known.
struct Bound {
  const SequenceInput* input = nullptr;
  std::vector<std::string> channels;
  Conversion conversion;
};

// Adds the frame to what went wrong.
template <class Action>
auto explained(std::int64_t frame, Action action) {
  try {
    return action();
  } catch (const Error& e) {
    throw Error(e.exit(), fmt::format("frame {}: {}", frame, e.what()));
  }
}

}  // namespace

class FileSequence::Impl {
 public:
  Impl(const Sequence& sequence, Missing missing) : sequence_(sequence), missing_(missing), roles_(sequence_.roles()) {}

  // What the frames of `roles` need of the disk; mistakes go to the diagnostics.
  void open(std::span<const std::string> roles, Diagnostics& diagnostics) {
    for (const auto& input : sequence_.inputs) {
      const bool wanted = roles.empty() || std::ranges::find(roles, input.role) != roles.end();
      if (wanted) needed_.push_back(&input);
    }
    for (const auto& role : roles)
      if (!sequence_.find(role)) {
        std::vector<std::string> names;
        for (const auto& [name, type] : roles_) names.push_back(name);
        diagnostics.error({}, "", fmt::format("the sequence '{}' has no role '{}'", sequence_.path, role),
                          {possibilities("it has", role, names)});
      }
    add_camera();
    look_for_files();
    for (const auto* input : needed_) bind(*input, frames_.front(), diagnostics);
    const auto& references = sequence_.references;
    for (const std::int64_t frame : frames_)
      if (!references.empty() && std::ranges::all_of(references, [&](const auto& i) { return there(i, frame); }))
        reference_frames_.push_back(frame);
    for (const auto& input : references)
      if (!reference_frames_.empty()) bind(input, reference_frames_.front(), diagnostics);
  }

  const std::vector<std::int64_t>& frames() const { return frames_; }
  const std::map<std::string, int>& roles() const { return roles_; }
  const std::vector<std::int64_t>& reference_frames() const { return reference_frames_; }
  const std::vector<std::int64_t>& missing_frames() const { return missing_frames_; }
  bool cut_before(std::int64_t frame) const { return cuts_.contains(frame); }
  bool declared_cut(std::int64_t frame) const { return sequence_.cuts.contains(frame); }

  quell_shape shape(std::int64_t frame, const std::string& role) {
    const Bound& bound = bound_of(role);
    const std::int64_t from = stand_in(*bound.input, frame);
    return explained(frame, [&] { return shape_of(bound, from); });
  }

  void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) {
    if (black_.contains(frame)) {
      for (std::size_t i = 0; i < roles.size(); ++i) fill_missing_role(roles[i], into[i]);
      return;
    }
    explained(frame, [&] {
      // Roles of one file are read in one pass over it.
      std::map<std::string, std::vector<std::size_t>> by_file;
      for (std::size_t i = 0; i < roles.size(); ++i) {
        const Bound& bound = bound_of(roles[i]);
        by_file[bound.input->file.path(stand_in(*bound.input, frame))].push_back(i);
      }
      if (watcher_) hash_files(by_file, frame, roles);
      for (const auto& [path, members] : by_file) read_file(path, members, frame, roles, into);
      return 0;
    });
  }

  void refuse_non_finite(std::span<const std::string> roles) { strict_.insert(roles.begin(), roles.end()); }
  std::map<std::string, Repairs> repairs() const { return repairs_; }
  void watch_files(FileWatcher watcher) { watcher_ = std::move(watcher); }

  // With the channels that were found in place of those that were looked for.
  std::string description(std::span<const std::string> roles) const {
    std::set<std::string> kept(roles.begin(), roles.end());
    if (camera_ && std::ranges::any_of(roles, [&](const std::string& r) { return reads_camera(r); }))
      kept.insert(camera_->role);
    Sequence found = sequence_;
    for (auto* list : {&found.inputs, &found.references}) {
      std::erase_if(*list, [&](const SequenceInput& i) { return !bound_.contains(i.role) || !kept.contains(i.role); });
      for (auto& input : *list) {
        const Bound& bound = bound_.at(input.role);
        input.choices = {{bound.channels, false, bound.conversion, {}}};
      }
    }
    return write_sequence(found);
  }

 private:
  // Conversions between spaces read the camera, even if no graph does.
  void add_camera() {
    camera_ = nullptr;
    for (const auto& input : sequence_.inputs)
      if (input.type == QUELL_CAMERA && (!camera_ || input.role == "camera")) camera_ = &input;
    const bool asked = std::ranges::any_of(needed_, [](const SequenceInput* i) {
      return std::ranges::any_of(i->choices, [](const ChannelChoice& c) { return c.conversion.needs_camera(); });
    });
    if (asked && camera_ && std::ranges::find(needed_, camera_) == needed_.end()) needed_.push_back(camera_);
  }

  bool there(const SequenceInput& input, std::int64_t frame) {
    const std::string path = input.file.path(frame);
    auto [found, fresh] = exists_.try_emplace(path, false);
    if (fresh) {
      std::error_code ignored;
      found->second = std::filesystem::exists(path, ignored);
    }
    if (found->second && input.format == FileFormat::cameras_json) return table(path).has(frame);
    return found->second;
  }

  void look_for_files() {
    std::vector<std::pair<std::int64_t, const SequenceInput*>> gone;
    std::set<std::int64_t> incomplete;
    for (const std::int64_t frame : sequence_.frames)
      for (const auto* input : needed_)
        if (!there(*input, frame)) {
          gone.emplace_back(frame, input);
          incomplete.insert(frame);
        }
    for (const std::int64_t frame : sequence_.frames)
      if (incomplete.contains(frame)) missing_frames_.push_back(frame);
    if (!gone.empty() && (missing_ == Missing::error || missing_frames_.size() == sequence_.frames.size())) {
      const auto& [frame, input] = gone.front();
      const std::string path = input->file.path(frame);
      const bool table = input->format == FileFormat::cameras_json && exists_[path];
      std::string text = fmt::format("frame {}: {}: {}: {}", frame, input->role, path,
                                     table ? "has no such frame" : "there is no such file");
      if (missing_frames_.size() > 1)
        text += fmt::format("\n  frames without all their files: {}", frame_range_text(missing_frames_));
      throw MissingFrames(text, missing_frames_.size() < sequence_.frames.size());
    }
    frames_ = sequence_.frames;
    if (missing_ == Missing::skip) std::erase_if(frames_, [&](std::int64_t f) { return incomplete.contains(f); });
    if (missing_ == Missing::black) black_ = incomplete;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const std::int64_t frame = frames_[i];
      const bool gap = i == 0 || frames_[i - 1] + 1 != frame;
      const bool dark = black_.contains(frame) || (i > 0 && black_.contains(frames_[i - 1]));
      if (gap || dark || sequence_.cuts.contains(frame)) cuts_.insert(frame);
    }
  }

  // The frame whose file serves `frame`: itself, or for a file that is not there the nearest before it, or else after
  // it.
  std::int64_t stand_in(const SequenceInput& input, std::int64_t frame) {
    if (missing_ == Missing::error || missing_ == Missing::skip || there(input, frame)) return frame;
    const auto& all = sequence_.frames;
    const auto at = std::ranges::find(all, frame) - all.begin();
    for (auto i = at; i-- > 0;)
      if (there(input, all[std::size_t(i)])) return all[std::size_t(i)];
    for (auto i = std::size_t(at); i < all.size(); ++i)
      if (there(input, all[i])) return all[i];
    return frame;
  }

  void bind(const SequenceInput& input, std::int64_t first, Diagnostics& diagnostics) {
    Bound bound{&input, {}, {}};
    if (input.format != FileFormat::image) {
      bound_[input.role] = std::move(bound);
      return;
    }
    const std::int64_t frame = stand_in(input, first);
    const std::string path = input.file.path(frame);
    explained(frame, [&] {
      const auto names = image(frame, path).channel_names();
      for (const auto& choice : input.choices) {
        if (choice.conversion.needs_camera() && !camera_) continue;
        bound.channels = find_channels(names, choice, input.type);
        bound.conversion = choice.conversion;
        if (!bound.channels.empty()) return 0;
      }
      report_channels(input, path, names, diagnostics);
      return 0;
    });
    bound_[input.role] = std::move(bound);
  }

  bool reads_camera(const std::string& role) const {
    const auto found = bound_.find(role);
    return found != bound_.end() && found->second.conversion.needs_camera();
  }

  const Bound& bound_of(const std::string& role) {
    const auto found = bound_.find(role);
    if (found != bound_.end()) return found->second;
    if (sequence_.find(role))
      throw Error(Exit::input, fmt::format("role '{}' was not opened, or no frame has its files", role));
    throw Error(Exit::input, fmt::format("the sequence '{}' has no role '{}'", sequence_.path, role));
  }

  // Files stay open from the look at their headers until another frame is asked for.
  ImageFile& image(std::int64_t frame, const std::string& path) {
    if (open_frame_ != frame) images_.clear(), open_frame_ = frame;
    const auto found = images_.find(path);
    return found != images_.end() ? found->second : images_.emplace(path, ImageFile(path)).first->second;
  }

  const CameraTable& table(const std::string& path) {
    const auto found = tables_.find(path);
    return found != tables_.end() ? found->second : tables_.emplace(path, CameraTable(path)).first->second;
  }

  const FrameMatrices& matrices(const SequenceInput& input, std::int64_t from) {
    const std::string path = input.file.path(from);
    if (input.format == FileFormat::cameras_json) return table(path).at(from);
    if (matrices_path_ != path) {
      matrices_ = read_games202_matrices(path);
      matrices_path_ = path;
    }
    return matrices_;
  }

  quell_shape shape_of(const Bound& bound, std::int64_t from) {
    const SequenceInput& input = *bound.input;
    if (input.type == QUELL_CAMERA) return camera_shape();
    if (input.type == QUELL_TRANSFORMS) return transforms_shape(matrices(input, from));
    ImageFile& file = image(from, input.file.path(from));
    quell_shape shape = file.size(channel_of(file, bound.channels.front()));
    for (const auto& name : bound.channels) {
      const quell_shape other = file.size(channel_of(file, name));
      if (other.width != shape.width || other.height != shape.height) {
        throw Error(
            Exit::input,
            fmt::format("{}: channels '{}' and '{}' have display windows of {} x {} and {} x {} pixels", file.path(),
                        bound.channels.front(), name, shape.width, shape.height, other.width, other.height));
      }
    }
    shape.channels = int(bound.channels.size());
    return shape;
  }

  static int channel_of(const ImageFile& file, const std::string& name) {
    const int channel = file.find(name);
    if (channel >= 0) return channel;
    const std::string note = possibilities("it has", name, file.channel_names());
    throw Error(Exit::input,
                fmt::format("{}: has no channel '{}', unlike the first frame\n  {}", file.path(), name, note));
  }

  static ColorEncoding encoding_of(const ImageFile& file, const Bound& bound) {
    auto encoding = file.encoding(channel_of(file, bound.channels.front()));
    if (encoding.curve == ColorEncoding::Curve::unknown)
      throw Error(Exit::input, fmt::format("{}: its colours are encoded as '{}', which is not decoded\n  convert it to "
                                           "linear OpenEXR, or to sRGB",
                                           file.path(), encoding.name));
    return encoding;
  }

  void read_file(const std::string& path, std::span<const std::size_t> members, std::int64_t frame,
                 std::span<const std::string> roles, std::span<const quell_image> into) {
    std::vector<ChannelRead> reads;
    std::vector<std::pair<std::size_t, Window>> windows;
    std::ptrdiff_t pitch = 0;
    for (const std::size_t i : members) {
      const Bound& bound = bound_of(roles[i]);
      const std::int64_t from = stand_in(*bound.input, frame);
      const quell_shape shape = shape_of(bound, from);
      const quell_image& to = into[i];
      if (to.width != shape.width || to.height != shape.height || to.channels != shape.channels) {
        throw Error(Exit::input,
                    fmt::format("{}: '{}' is {} x {} pixels with {} channels, not {} x {} with {}", path, roles[i],
                                shape.width, shape.height, shape.channels, to.width, to.height, to.channels));
      }
      if (bound.input->type == QUELL_CAMERA) {
        store_camera(matrices(*bound.input, from), to);
      } else if (bound.input->type == QUELL_TRANSFORMS) {
        store_transforms(matrices(*bound.input, from), to);
      } else {
        ImageFile& file = image(from, path);
        Window window{0, 0, shape.width, shape.height};
        for (std::size_t c = 0; c < bound.channels.size(); ++c) {
          const int channel = channel_of(file, bound.channels[c]);
          reads.push_back({channel, to.plane[c], bound.input->type == QUELL_ID});
          window = intersection(window, file.covered(channel));
        }
        windows.emplace_back(i, window);
        pitch = to.pitch;
      }
    }
    if (windows.empty()) return;
    ImageFile& file = images_.at(path);
    file.read(reads, pitch);
    for (const auto& [i, window] : windows) {
      const Bound& bound = bound_of(roles[i]);
      Conversion conversion = bound.conversion;
      const bool color = bound.input->type == QUELL_RADIANCE || bound.input->type == QUELL_ALBEDO;
      if (color) conversion.light = encoding_of(file, bound);
      const FrameMatrices* camera =
          conversion.needs_camera() ? &matrices(*camera_, stand_in(*camera_, frame)) : nullptr;
      const auto broken = convert(into[i], bound.input->type, window, conversion, camera, repairs_[roles[i]]);
      if (broken && strict_.contains(roles[i])) refuse(path, roles[i], bound, *broken);
    }
  }

  [[noreturn]] static void refuse(const std::string& path, const std::string& role, const Bound& bound,
                                  const BrokenPixel& p) {
    throw Error(
        Exit::input,
        fmt::format("{}: '{}' is not finite: pixel ({}, {}) holds {} in channel '{}'\n  an error cannot be told "
                    "from such pixels; repair the file, or leave the frame out",
                    path, role, p.x, p.y, p.value, bound.channels[std::size_t(p.channel)]));
  }

  // Before they are read, so that of a file on a disk the second pass comes from memory.
  void hash_files(const std::map<std::string, std::vector<std::size_t>>& by_file, std::int64_t frame,
                  std::span<const std::string> roles) {
    std::map<std::string, std::vector<std::string>> uses;  // by path
    for (const auto& [path, members] : by_file)
      for (const auto i : members) uses[path].push_back(roles[i]);
    for (const auto& role : roles)
      if (reads_camera(role)) uses[camera_->file.path(stand_in(*camera_, frame))].push_back(role);
    std::vector<std::string> paths;
    for (const auto& [path, readers] : uses) paths.push_back(path);
    for (const auto& [path, hash] : hashes_.of(paths))
      watcher_({frame, name_below(sequence_.root, path), hash, uses.at(path)});
  }

  void fill_missing_role(const std::string& role, const quell_image& image) {
    fill_missing(image, bound_of(role).input->type);
  }

  Sequence sequence_;
  Missing missing_;
  std::map<std::string, int> roles_;
  std::vector<const SequenceInput*> needed_;
  const SequenceInput* camera_ = nullptr;
  std::vector<std::int64_t> frames_, reference_frames_, missing_frames_;
  std::set<std::int64_t> cuts_, black_;
  std::map<std::string, Bound> bound_;
  std::unordered_map<std::string, bool> exists_;
  std::map<std::string, CameraTable> tables_;
  std::optional<std::int64_t> open_frame_;
  std::map<std::string, ImageFile> images_;
  std::string matrices_path_;
  FrameMatrices matrices_;
  std::map<std::string, Repairs> repairs_;
  std::set<std::string> strict_;  // roles that may hold nothing that is not finite
  FileWatcher watcher_;
  FileHashes hashes_;
};

FileSequence::FileSequence(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
FileSequence::~FileSequence() = default;

const std::vector<std::int64_t>& FileSequence::frames() const { return impl_->frames(); }
bool FileSequence::cut_before(std::int64_t frame) const { return impl_->cut_before(frame); }
bool FileSequence::declared_cut(std::int64_t frame) const { return impl_->declared_cut(frame); }
const std::map<std::string, int>& FileSequence::roles() const { return impl_->roles(); }
std::vector<quell_shape> FileSequence::shapes(std::int64_t frame, std::span<const std::string> roles) {
  std::vector<quell_shape> out;
  for (const auto& role : roles) out.push_back(impl_->shape(frame, role));
  return out;
}
void FileSequence::read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) {
  impl_->read(frame, roles, into);
}
void FileSequence::refuse_non_finite(std::span<const std::string> roles) { impl_->refuse_non_finite(roles); }
std::map<std::string, Repairs> FileSequence::repairs() const { return impl_->repairs(); }
std::string FileSequence::description(const std::filesystem::path&, std::span<const std::string> roles) const {
  return impl_->description(roles);
}
void FileSequence::watch_files(FileWatcher watcher) { impl_->watch_files(std::move(watcher)); }
const std::vector<std::int64_t>& FileSequence::reference_frames() const { return impl_->reference_frames(); }
const std::vector<std::int64_t>& FileSequence::missing_frames() const { return impl_->missing_frames(); }

std::unique_ptr<FileSequence> open_sequence(const Sequence& sequence, std::span<const std::string> roles,
                                            Missing missing, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errors();
  auto impl = std::make_unique<FileSequence::Impl>(sequence, missing);
  impl->open(roles, diagnostics);
  if (diagnostics.errors() != before) return nullptr;
  return std::unique_ptr<FileSequence>(new FileSequence(std::move(impl)));
}

}  // namespace quell
