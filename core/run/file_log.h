// Which files the frames of a source were made from, as they are read.
#pragma once

#include "core/sequence/frame_source.h"

#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace quell {

class FileLog {
 public:
  // The source tells of its files from now on; it reads nothing after this is gone.
  explicit FileLog(FrameSource&);
  FileLog(const FileLog&) = delete;
  FileLog& operator=(const FileLog&) = delete;

  // Hashes by name, of the files that one of these roles was read from. A frame is complete once it was read.
  std::map<std::string, std::string> files(std::int64_t frame, std::span<const std::string> roles) const;
  // Frames that were read.
  std::vector<std::int64_t> frames() const;

  // All of it as JSON, and what an earlier log wrote taken in; false when that is none.
  std::string text() const;
  bool take(const std::string& text);

 private:
  mutable std::mutex mutex_;                                       // frames are read while earlier ones are written
  std::map<std::int64_t, std::map<std::string, FileRead>> files_;  // by frame and name
};

}  // namespace quell
