// Channels as the files hold them: halves become floats without loss, whole numbers stay what they are.
#include "apps/quell/picture_difference.h"

#include "core/sequence/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace quell {

namespace {

struct Picture {
  std::vector<std::string> names;
  std::vector<bool> whole;  // whole numbers
  int width = 0, height = 0;
  std::vector<std::vector<float>> planes;

  explicit Picture(const std::string& path) {
    ImageFile file(path);
    std::vector<ChannelRead> reads;
    const auto& channels = file.channels();
    planes.resize(channels.size());
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const auto size = file.size(int(c));
      width = size.width, height = size.height;
      names.push_back(channels[c].name);
      whole.push_back(channels[c].storage == FileChannel::Storage::integer);
      planes[c].assign(std::size_t(width) * std::size_t(height), 0.0f);
      reads.push_back({int(c), planes[c].data(), whole.back()});
    }
    file.read(reads, width);
  }
  std::string shape() const {
    return fmt::format("{} x {} pixels with channels {}", width, height, fmt::join(names, ", "));
  }
  std::string value(std::size_t channel, std::size_t pixel) const {
    const float v = planes[channel][pixel];
    return whole[channel] ? fmt::format("{}", std::bit_cast<std::uint32_t>(v)) : fmt::format("{}", v);
  }
};

}  // namespace

std::string picture_difference(const std::string& then, const std::string& now) {
  const Picture a(then), b(now);
  if (a.shape() != b.shape()) return fmt::format("it had {}, now {}", a.shape(), b.shape());
  std::vector<bool> differs(std::size_t(a.width) * std::size_t(a.height));
  double largest = -1;
  std::size_t at = 0, of = 0;
  for (std::size_t c = 0; c < a.planes.size(); ++c)
    for (std::size_t p = 0; p < differs.size(); ++p) {
      const float x = a.planes[c][p], y = b.planes[c][p];
      if (std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y)) continue;
      differs[p] = true;
      const double distance =
          a.whole[c] ? std::abs(double(std::bit_cast<std::uint32_t>(x)) - double(std::bit_cast<std::uint32_t>(y)))
                     : std::abs(double(x) - double(y));
      if (distance > largest) largest = distance, at = p, of = c;
    }
  const auto count = std::ranges::count(differs, true);
  if (count == 0) return "";
  return fmt::format("{} of {} pixels, by at most {:.6g}: {} of pixel ({}, {}) was {}, now {}", count, differs.size(),
                     std::max(largest, 0.0), a.names[of], at % std::size_t(a.width), at / std::size_t(a.width),
                     a.value(of, at), b.value(of, at));
}

}  // namespace quell
