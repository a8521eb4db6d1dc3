// What reading an OpenEXR file into planes of float costs, against OpenImageIO's read into interleaved floats.
//
// exr_read_bench [FILE…]: all channels of each file, on one thread, the two interleaved in one process; medians of CPU
// time. Without files: a 1080p frame of 12 half channels made in memory, once for each compression.
#include "core/bench/synthetic_source.h"
#include "core/sequence/exr_writer.h"
#include "core/sequence/image_file.h"
#include "tests/bench/turns.h"
#include "tests/support/scratch.h"

#include <quell/types.h>

#include <OpenImageIO/imageio.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace {

constexpr int kRounds = 7;

void compare(const std::string& name, const std::string& path) {
  const quell::ImageFile header(path);
  const auto size = header.size(0);
  const int channels = int(header.channels().size());
  quell::Image planes(size.width, size.height, channels);
  std::vector<float> interleaved(std::size_t(size.width) * std::size_t(size.height) * std::size_t(channels));
  std::vector<quell::ChannelRead> reads;
  for (int c = 0; c < channels; ++c) reads.push_back({c, planes.row(c, 0)});
  std::vector<double> ours, theirs;
  for (int round = 0; round <= kRounds; ++round) {
    const double a = quell::bench::cpu_seconds_of([&] { quell::ImageFile(path).read(reads, planes.pitch()); });
    const double b = quell::bench::cpu_seconds_of([&] {
      const auto in = OIIO::ImageInput::open(path);
      if (!in || !in->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, interleaved.data()))
        std::printf("%s: %s\n", path.c_str(), OIIO::geterror().c_str());
    });
    if (round > 0) ours.push_back(a), theirs.push_back(b);  // the first warms up
  }
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::printf("%-16s %2d channels, %5.1f MB: OpenImageIO %6.1f ms, planes %6.1f ms, ratio %.2f\n", name.c_str(),
              channels, double(file.tellg()) / 1e6, quell::bench::median(theirs) * 1e3,
              quell::bench::median(ours) * 1e3, quell::bench::median(ours) / quell::bench::median(theirs));
}

}  // namespace

int main(int argc, char** argv) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  for (int i = 1; i < argc; ++i) compare(std::string(argv[i]).substr(std::string(argv[i]).rfind('/') + 1), argv[i]);
  if (argc > 1) return 0;
  const quell::test::Scratch scratch;
  std::vector<quell::Image> images;
  std::vector<float*> planes;
  std::vector<quell::ExrChannel> channels;
  for (const int type : {QUELL_RADIANCE, QUELL_ALBEDO, QUELL_NORMAL, QUELL_DEPTH, QUELL_MOTION}) {
    images.push_back(quell::synthetic_image(type, 1920, 1080, 0));
    for (int c = 0; c < images.back().channels(); ++c) {
      planes.push_back(images.back().row(c, 0));
      channels.push_back({"F" + std::to_string(100 + planes.size()), quell::ExrChannel::Storage::half});
    }
  }
  const quell_image frame{planes.data(), 1920, 1080, int(planes.size()), 0, images[0].pitch()};
  for (const auto& compression : quell::exr_compressions()) {
    const auto bytes = quell::encode_exr(frame, channels, {compression, {}}, {});
    const auto path = scratch.path(compression + ".exr");
    std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
    compare(compression, path);
  }
}
