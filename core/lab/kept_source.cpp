// A source whose images are kept on disk.
#include "core/lab/kept_source.h"

#include "core/report/error.h"
#include "core/run/named_files.h"
#include "core/sequence/file_hash.h"
#include "core/sequence/image_file.h"
#include "core/sequence/image_writer.h"

#include <fmt/format.h>

#include <utility>

namespace quell {

KeptSource::KeptSource(std::unique_ptr<FrameSource> source, std::string role, std::filesystem::path folder,
                       std::map<std::string, std::string> made_from)
    : source_(std::move(source)),
      role_(std::move(role)),
      folder_(std::move(folder)),
      made_from_(std::move(made_from)) {}

void KeptSource::watch_files(FileWatcher watcher) {
  watcher_ = watcher;
  source_->watch_files(std::move(watcher));
}

bool KeptSource::read_kept(const std::string& path, const quell_image& into) const {
  if (!std::filesystem::exists(path)) return false;
  try {
    return read_whole(path, into);
  } catch (const Error&) {
    return false;  // damaged: it is made again
  }
}

bool KeptSource::read_whole(const std::string& path, const quell_image& into) const {
  ImageFile file(path);
  const auto names = channel_names(roles().at(role_), into.channels);
  std::vector<ChannelRead> reads;
  for (std::size_t c = 0; c < names.size(); ++c) {
    const int channel = file.find(names[c]);
    if (channel < 0) return false;
    const auto size = file.size(channel);
    if (size.width != into.width || size.height != into.height) return false;
    reads.push_back({channel, into.plane[c]});
  }
  file.read(reads, into.pitch);
  return true;
}

void KeptSource::read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) {
  if (roles.size() != 1 || roles[0] != role_) return source_->read(frame, roles, into);
  const auto path = (folder_ / fmt::format("frame.{:04}.exr", frame)).string();
  if (read_kept(path, into[0])) {
    if (watcher_)
      for (const auto& [name, hash] : made_from_) watcher_({frame, name, hash, {role_}});
    return;
  }
  source_->read(frame, roles, into);
  WriteOptions options;
  options.half = false;
  write_image(path, into[0], this->roles().at(role_), options);
}

std::string node_identity(Instance node) {
  for (std::size_t p = 0; p < node.type().params().size(); ++p)
    if (node.type().params()[p].kind == QUELL_PATH)
      if (const auto file = std::string(node.get_text(int(p))); !file.empty()) node.set_text(int(p), file_hash(file));
  return fmt::format("{} {} {}\n", node.type().name(), node.type().version(), node.describe());
}

std::unique_ptr<FrameSource> keep_reference(std::unique_ptr<NodeSource> source, const Instance& node,
                                            const std::filesystem::path& references) {
  if (references.empty()) return source;
  return std::make_unique<KeptSource>(std::move(source), "color", references / text_hash(node_identity(node)),
                                      named_files("source", node));
}

}  // namespace quell
