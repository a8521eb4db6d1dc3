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
#include <random>

#include <fcntl.h>
#include <unistd.h>

namespace quell {

namespace fs = std::filesystem;

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

[[noreturn]] void fail(const std::string& path, const char* doing) {
  const int error = errno;
  throw Error(Exit::resources, fmt::format("cannot {} '{}': {}", doing, path, std::strerror(error)));
}

// Devices and pipes cannot be renamed over: that would put a file in their place.
void check_replaceable(const std::string& path) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (fs::is_directory(status)) errno = EISDIR, fail(path, "write");
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw Error(Exit::resources, fmt::format("cannot write '{}': it is a device or pipe, not a file", path));
}

}  // namespace

void write_file(const std::string& path, std::string_view text) {
  TemporaryFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

void check_writable(const std::string& path) {
  check_replaceable(path);
  std::error_code error;
  fs::path folder = fs::path(path).parent_path();
  while (!folder.empty() && !fs::exists(folder, error)) folder = folder.parent_path();
  if (folder.empty()) folder = ".";
  if (!fs::is_directory(folder, error))
    throw Error(Exit::resources, fmt::format("cannot write '{}': '{}' is no folder", path, folder.string()));
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw Error(Exit::resources,
                fmt::format("cannot write '{}': the folder '{}': {}", path, folder.string(), std::strerror(errno)));
}

void remove_temporaries() {
  for (auto& slot : slots)
    if (slot.state == kUsed) unlink(slot.path);
}

TemporaryFile::TemporaryFile(std::string path) : path_(std::move(path)) {
  check_replaceable(path_);
  // A link stays one: what it points to is replaced, or made.
  fs::path target = path_;
  std::error_code error;
  for (int links = 0; links < 40 && fs::is_symlink(target, error); ++links)
    target = target.parent_path() / fs::read_symlink(target, error);
  error.clear();
  target_ = target.string();
  if (target.has_parent_path()) fs::create_directories(target.parent_path(), error);
  if (error) throw Error(Exit::resources, fmt::format("cannot make the folder of '{}': {}", path_, error.message()));
  std::random_device random;
  for (int tries = 0; tries < 100; ++tries) {
    // Hidden, so that no pattern finds it.
    temporary_ = (target.parent_path() / fmt::format(".{}.{:08x}", target.filename().string(), random())).string();
    if (temporary_.size() >= PATH_MAX) errno = ENAMETOOLONG, fail(path_, "write");
    // Before it exists, so that no signal comes between.
    slot_ = register_temporary(temporary_);
    if (slot_ < 0) errno = EMFILE, fail(path_, "write");
    file_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ >= 0) return;
    slots[std::size_t(slot_)].state = kFree;
    if (errno != EEXIST) fail(path_, "write");
  }
  fail(path_, "write");
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
    if (n < 0) fail(path_, "write");
    bytes += n, size -= std::size_t(n);
  }
}

void TemporaryFile::commit() {
  const int file = file_;
  file_ = -1;
  if (close(file) != 0) fail(path_, "write");
  if (rename(temporary_.c_str(), target_.c_str()) != 0) fail(path_, "rename a finished file to");
  slots[std::size_t(slot_)].state = kFree;
  slot_ = -1;
}

}  // namespace quell
