// Files that exist under a name of their own until they are whole.
#pragma once

#include <string>
#include <string_view>

namespace quell {

// Created beside `path`, and removed again unless committed: by the destructor, or by remove_temporaries() when the
// program ends in another way. Makes the folders above `path`. Throws Error(Exit::resources) with the path and the
// reason; so also when `path` is a folder, a device or a pipe.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string path);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(const void* data, std::size_t size);
  // Gives the file its name, in place of one that may be there.
  void commit();

 private:
  std::string path_, target_, temporary_;
  int file_ = -1;
  int slot_ = -1;
};

// The whole text under this name, or nothing.
void write_file(const std::string& path, std::string_view text);

// Throws what making a TemporaryFile of this path would throw, as far as a look can tell, and makes nothing: so that a
// long run does not fail at its end.
void check_writable(const std::string& path);

// Removes what TemporaryFiles have not committed. May be called from a signal handler.
void remove_temporaries();

}  // namespace quell
