// FNV-1a.
#include "core/lab/digest.h"

#include "core/report/error.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

namespace quell {

std::string digest(std::string_view text) {
  std::uint64_t hash = 14695981039346656037u;
  for (const unsigned char c : text) hash = (hash ^ c) * 1099511628211u;
  return fmt::format("{:016x}", hash);
}

std::string digest_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(Exit::input, fmt::format("cannot read {}", path));
  return digest(std::string{std::istreambuf_iterator<char>(in), {}});
}

}  // namespace quell
