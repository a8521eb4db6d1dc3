// Files by frame and name.
#include "core/run/file_log.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace quell {

using nlohmann::json;

FileLog::FileLog(FrameSource& source) {
  source.watch_files([this](const FileRead& read) {
    const std::scoped_lock lock(mutex_);
    const auto [it, fresh] = files_[read.frame].try_emplace(read.name, read);
    if (fresh) return;
    // The same file for other roles too.
    it->second.hash = read.hash;
    for (const auto& role : read.roles)
      if (std::ranges::find(it->second.roles, role) == it->second.roles.end()) it->second.roles.push_back(role);
  });
}

std::map<std::string, std::string> FileLog::files(std::int64_t frame, std::span<const std::string> roles) const {
  std::map<std::string, std::string> files;
  const std::scoped_lock lock(mutex_);
  if (const auto it = files_.find(frame); it != files_.end())
    for (const auto& [name, read] : it->second)
      if (std::ranges::find_first_of(read.roles, roles) != read.roles.end()) files[name] = read.hash;
  return files;
}

std::vector<std::int64_t> FileLog::frames() const {
  std::vector<std::int64_t> frames;
  const std::scoped_lock lock(mutex_);
  for (const auto& [frame, files] : files_) frames.push_back(frame);
  return frames;
}

std::string FileLog::text() const {
  json all = json::array();
  const std::scoped_lock lock(mutex_);
  for (const auto& [frame, files] : files_)
    for (const auto& [name, read] : files) all.push_back({frame, name, read.hash, read.roles});
  // Names of files need not be UTF-8.
  return all.dump(-1, ' ', false, json::error_handler_t::replace);
}

bool FileLog::take(const std::string& text) {
  try {
    std::map<std::int64_t, std::map<std::string, FileRead>> files;
    for (const auto& entry : json::parse(text)) {
      FileRead read{entry.at(0), entry.at(1), entry.at(2), entry.at(3)};
      files[read.frame][read.name] = std::move(read);
    }
    const std::scoped_lock lock(mutex_);
    files_.merge(files);
    return true;
  } catch (const json::exception&) {
    return false;
  }
}

}  // namespace quell
