// Images as OpenEXR files in memory.
#pragma once

#include <quell/abi.h>

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace quell {

// How an OpenEXR file is compressed: "zip", or with a level, "zip:9", "dwaa:100".
struct ExrCompression {
  std::string name = "zip";
  std::optional<int> level;  // zip, zips: 1 to 12, time for size; dwaa, dwab: 0 to 100000, size for quality
};
std::span<const std::string> exr_compressions();
// Nothing for a name that there is not, or a level that it does not take.
std::optional<ExrCompression> parse_exr_compression(std::string_view text);

struct ExrChannel {
  enum class Storage { half, floating, integer };
  std::string name;
  Storage storage;
};

// The whole file; `channels` describes each plane. Halves are the nearest, up to ±65504. Shares the work among the
// threads of the caller's arena. Throws std::exception.
std::vector<char> encode_exr(const quell_image& image, std::span<const ExrChannel> channels, const ExrCompression&,
                             const std::map<std::string, std::string>& metadata);

}  // namespace quell
