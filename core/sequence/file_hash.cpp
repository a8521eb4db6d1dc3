// Hashes through a buffer that stays in the cache: as fast as from mapped memory, and a file that shrinks meanwhile is
// an error rather than a fault.
#include "core/sequence/file_hash.h"

#include "core/report/error.h"
#include "core/sequence/pieces.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

namespace quell {

namespace {

constexpr std::size_t kBufferBytes = std::size_t(1) << 18;

std::string digits(XXH64_hash_t hash) { return fmt::format("{:016x}", hash); }

}  // namespace

std::string file_hash(const std::string& path) {
  const auto fail = [&] {
    const int error = errno;
    throw Error(Exit::input, fmt::format("{}: cannot be read: {}", path, std::strerror(error)));
  };
  struct File {
    int number;
    ~File() {
      if (number >= 0) close(number);
    }
  };
  const File file{open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.number < 0) fail();
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(), XXH3_freeState);
  if (!state) throw std::bad_alloc();
  XXH3_64bits_reset(state.get());
  thread_local std::vector<char> buffer(kBufferBytes);
  for (;;) {
    const ssize_t n = read(file.number, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail();
    if (n == 0) return digits(XXH3_64bits_digest(state.get()));
    XXH3_64bits_update(state.get(), buffer.data(), std::size_t(n));
  }
}

std::string text_hash(std::string_view text) { return digits(XXH3_64bits(text.data(), text.size())); }

const std::map<std::string, std::string>& FileHashes::of(const std::vector<std::string>& paths) {
  std::vector<std::string> hashes(paths.size());
  in_pieces(int(paths.size()), [&](int i) {
    const auto known = last_.find(paths[std::size_t(i)]);
    hashes[std::size_t(i)] = known == last_.end() ? file_hash(paths[std::size_t(i)]) : known->second;
  });
  last_.clear();
  for (std::size_t i = 0; i < paths.size(); ++i) last_.emplace(paths[i], std::move(hashes[i]));
  return last_;
}

}  // namespace quell
