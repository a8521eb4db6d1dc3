// What encoding an OpenEXR file of three half channels costs by each compression, and how long it gets, against
// OpenImageIO from interleaved floats.
//
// exr_write_bench [FILE]: R, G and B of an image, on one thread, the two interleaved in one process; medians of CPU
// time. Without a file: 1080p radiance made in memory, which is noisier than what a denoiser writes.
#include "core/bench/synthetic_source.h"
#include "core/sequence/exr_writer.h"
#include "core/sequence/image_file.h"
#include "tests/bench/turns.h"

#include <quell/types.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace {

constexpr int kRounds = 5;

quell::Image load(const std::string& path) {
  quell::ImageFile file(path);
  const auto size = file.size(0);
  quell::Image image(size.width, size.height, 3);
  std::vector<quell::ChannelRead> reads;
  for (const char* name : {"R", "G", "B"}) reads.push_back({file.find(name), image.row(int(reads.size()), 0)});
  file.read(reads, image.pitch());
  return image;
}

std::size_t by_oiio(const std::string& compression, const quell::Image& image, const std::vector<float>& pixels) {
  OIIO::Filesystem::IOVecOutput bytes;
  const auto out = OIIO::ImageOutput::create("openexr");
  OIIO::ImageSpec spec(image.width(), image.height(), 3, OIIO::TypeDesc::HALF);
  spec.attribute("compression", compression);
  out->set_ioproxy(&bytes);
  if (!out->open("a.exr", spec) || !out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) || !out->close())
    std::printf("%s\n", out->geterror().c_str());
  return bytes.buffer().size();
}

}  // namespace

int main(int argc, char** argv) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  const auto image = argc > 1 ? load(argv[1]) : quell::synthetic_image(QUELL_RADIANCE, 1920, 1080, 0);
  std::vector<float> pixels;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      for (int c = 0; c < 3; ++c) pixels.push_back(image.at(c, x, y));
  const std::vector<quell::ExrChannel> channels = {{"R", quell::ExrChannel::Storage::half},
                                                   {"G", quell::ExrChannel::Storage::half},
                                                   {"B", quell::ExrChannel::Storage::half}};
  std::vector<std::string> texts;
  for (const auto& name : quell::exr_compressions()) {
    texts.push_back(name);
    if (name.starts_with("zip"))
      for (const int level : {1, 2, 3, 4, 6, 9}) texts.push_back(name + ":" + std::to_string(level));
  }
  for (const auto& text : texts) {
    const auto compression = *quell::parse_exr_compression(text);
    std::vector<double> ours, theirs;
    std::size_t our_size = 0, their_size = 0;
    for (int round = 0; round < kRounds; ++round) {
      ours.push_back(quell::bench::cpu_seconds_of(
          [&] { our_size = quell::encode_exr(image.view(), channels, compression, {}).size(); }));
      if (!compression.level)
        theirs.push_back(quell::bench::cpu_seconds_of([&] { their_size = by_oiio(text, image, pixels); }));
    }
    std::printf("%-8s %6.1f ms, %6.2f MB", text.c_str(), quell::bench::median(ours) * 1e3, double(our_size) / 1e6);
    if (!theirs.empty())
      std::printf("   OpenImageIO %6.1f ms, %6.2f MB, ratio %.2f", quell::bench::median(theirs) * 1e3,
                  double(their_size) / 1e6, quell::bench::median(ours) / quell::bench::median(theirs));
    std::printf("\n");
  }
}
