// The lock is on a file in the folder, and the system's.
#include "core/lab/folder_lock.h"

#include "core/report/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace quell {

FolderLock::FolderLock(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const auto path = (folder / ".lock").string();
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) throw Error(Exit::resources, fmt::format("{}: {}", path, std::strerror(errno)));
  if (flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;  // some file systems have no locks
  close(file_);
  throw Error(Exit::usage,
              fmt::format("another run is at work in {}\n  wait for its end, or choose another folder with -o",
                          folder.string()));
}

FolderLock::~FolderLock() { close(file_); }

}  // namespace quell
