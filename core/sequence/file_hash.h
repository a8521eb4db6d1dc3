// What a file holds, as a number that tells whether it is still the same.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace quell {

// XXH3 of the file's bytes as 16 hexadecimal digits, which `xxhsum -H3 FILE` prints too. It finds what has changed, not
// who meant to hide it. Throws Error(Exit::input) when the file cannot be read.
std::string file_hash(const std::string& path);
// The same of a text.
std::string text_hash(std::string_view);

// Hashes of the files of one frame after the other: a file that serves several is hashed once.
class FileHashes {
 public:
  // By path. Shares the work among the threads of the caller's arena.
  const std::map<std::string, std::string>& of(const std::vector<std::string>& paths);

 private:
  std::map<std::string, std::string> last_;
};

}  // namespace quell
