// Temporary files, and the table of them that a signal handler can walk.
#include "core/sequence/temporary_file.h"

#include "core/report/error.h"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace quell {

namespace {

enum State : int { kFree, kFilling, kUsed };

struct Slot {
  std::atomic<int> state = kFree;
  char path[PATH_MAX];
};

// No container and no lock: a handler may interrupt anything.
std::array<Slot, 64> slots;

int register_temporary(const std::string& path) {
  for (std::size_t i = 0; i < slots.size(); ++i) {
    int expected = kFree;
    if (!slots[i].state.compare_exchange_strong(expected, kFilling)) continue;
    std::memcpy(slots[i].path, path.c_str(), path.size() + 1);
    slots[i].state = kUsed;
    return int(i);
  }
  return -1;
}

}  // namespace

void remove_temporaries() {
  for (auto& slot : slots)
    if (slot.state == kUsed) unlink(slot.path);
}

void TemporaryFile::fail(const char* doing) const {
  const int error = errno;
  throw Error(Exit::resources, fmt::format("cannot {} '{}': {}", doing, path_, std::strerror(error)));
}

TemporaryFile::TemporaryFile(std::string path) : path_(std::move(path)) {
  const std::filesystem::path target = path_;
  std::error_code error;
  if (target.has_parent_path()) std::filesystem::create_directories(target.parent_path(), error);
  if (error) throw Error(Exit::resources, fmt::format("cannot make the folder of '{}': {}", path_, error.message()));
  if (std::filesystem::is_directory(target, error)) {
    errno = EISDIR;
    fail("write");
  }
  // Hidden, so that no pattern finds it.
  temporary_ = (target.parent_path() / fmt::format(".{}.XXXXXX", target.filename().string())).string();
  if (temporary_.size() >= PATH_MAX) {
    errno = ENAMETOOLONG;
    fail("write");
  }
  // A template for mkostemp has its own name only afterwards; a signal between the two calls would leave an empty file.
  file_ = mkostemp(temporary_.data(), O_CLOEXEC);
  if (file_ < 0) fail("write");
  slot_ = register_temporary(temporary_);
  if (slot_ < 0) {
    close(file_);
    unlink(temporary_.c_str());
    errno = EMFILE;
    fail("write");
  }
}

TemporaryFile::~TemporaryFile() {
  if (file_ >= 0) close(file_);
  if (slot_ < 0) return;
  unlink(temporary_.c_str());
  slots[std::size_t(slot_)].state = kFree;
}

void TemporaryFile::write(const void* data, std::size_t size) {
  const char* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = ::write(file_, bytes, size);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("write");
    bytes += n, size -= std::size_t(n);
  }
}

void TemporaryFile::commit() {
  // mkostemp gives the file to its owner alone; others read results as the user's mask says.
  const mode_t mask = umask(0);
  umask(mask);
  if (fchmod(file_, 0666 & ~mask) != 0) fail("write");
  const int file = file_;
  file_ = -1;
  if (close(file) != 0) fail("write");
  if (rename(temporary_.c_str(), path_.c_str()) != 0) fail("rename a finished file to");
  slots[std::size_t(slot_)].state = kFree;
  slot_ = -1;
}

}  // namespace quell
