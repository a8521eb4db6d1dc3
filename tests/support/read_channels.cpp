// Channels are expected to be there.
#include "tests/support/read_channels.h"

#include "core/sequence/image_file.h"

#include <gtest/gtest.h>

namespace quell::test {

Image read_channels(const std::string& path, const std::vector<std::string>& names, float before, bool id) {
  ImageFile file(path);
  const auto size = file.size(file.find(names.at(0)));
  Image image(size.width, size.height, int(names.size()));
  image.fill(before);
  std::vector<ChannelRead> reads;
  for (std::size_t c = 0; c < names.size(); ++c) {
    EXPECT_GE(file.find(names[c]), 0) << names[c];
    reads.push_back({file.find(names[c]), image.row(int(c), 0), id});
  }
  file.read(reads, image.pitch());
  return image;
}

}  // namespace quell::test
