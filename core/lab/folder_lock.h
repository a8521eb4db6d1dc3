// A folder of results, held by one process at a time.
#pragma once

#include <filesystem>

namespace quell {

class FolderLock {
 public:
  // Makes the folder where it is not there. Throws Error(Exit::usage) when another process holds it; one that ended in
  // any way holds nothing.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

}  // namespace quell
