// Images to files: what is written is what is read back, and what cannot be written leaves nothing behind.
#include "core/sequence/image_writer.h"

#include "core/sequence/image_file.h"
#include "core/sequence/temporary_file.h"
#include "tests/support/failure.h"
#include "tests/support/read_channels.h"
#include "tests/support/run_node.h"
#include "tests/support/scratch.h"

#include <quell/types.h>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>

namespace quell::test {
namespace {

TEST(ImageWriter, KeepsFloatsAndRoundsToHalf) {
  const Scratch scratch;
  for (const auto& compression : {"none", "zips", "zip", "piz", "rle"}) {
    for (const auto& [width, height] : {std::pair(1, 1), {17, 3}, {1, 70}, {130, 67}}) {
      Image image = test::noise_image(width, height, 3, 1, 0.0f, 10.0f);
      write_image(scratch.path("f.exr"), image.view(), QUELL_RADIANCE, {false, {compression, {}}, {}});
      EXPECT_TRUE(same_bits(read_channels(scratch.path("f.exr"), {"R", "G", "B"}), image));
      write_image(scratch.path("h.exr"), image.view(), QUELL_RADIANCE, {true, {compression, {}}, {}});
      const Image half = read_channels(scratch.path("h.exr"), {"R", "G", "B"});
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) ASSERT_NEAR(half.at(1, x, y), image.at(1, x, y), 10.0f / 2048) << compression;
    }
  }
}

TEST(ImageWriter, ClampsWhatHalfCannotHold) {
  const Scratch scratch;
  Image image = test::constant_image(2, 1, 3, 1e9f);
  image.at(0, 1, 0) = 65519.0f;  // rounds to 65504, 65520 would be infinite
  write_image(scratch.path("a.exr"), image.view(), QUELL_RADIANCE);
  const Image back = read_channels(scratch.path("a.exr"), {"R", "G"});
  EXPECT_EQ(back.at(0, 0, 0), 65504.0f);
  EXPECT_EQ(back.at(0, 1, 0), 65504.0f);
}

TEST(ImageWriter, WritesDepthAsFloatAndIdsAsWholeNumbers) {
  const Scratch scratch;
  Image depth = test::constant_image(3, 2, 1, kFar);
  depth.at(0, 1, 1) = 1.00001f;
  write_image(scratch.path("z.exr"), depth.view(), QUELL_DEPTH);
  EXPECT_TRUE(same_bits(read_channels(scratch.path("z.exr"), {"Z"}), depth));

  Image id(3, 2, 1);
  fill_missing(id.view(), QUELL_ID);
  id.bits(0, 1)[2] = 4000000001u;
  write_image(scratch.path("id.exr"), id.view(), QUELL_ID);
  EXPECT_TRUE(same_bits(read_channels(scratch.path("id.exr"), {"Y"}, 0.0f, true), id));
  EXPECT_EQ(ImageFile(scratch.path("id.exr")).channels()[0].storage, FileChannel::Storage::integer);

  Image taps = test::noise_image(5, 4, 5, 3);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x) taps.bits(4, y)[x] = std::uint32_t(x + 512);
  write_image(scratch.path("taps.exr"), taps.view(), QUELL_TAPS);
  EXPECT_EQ(read_channels(scratch.path("taps.exr"), {"mask"}).at(0, 2, 1), 514.0f);
  EXPECT_EQ(read_channels(scratch.path("taps.exr"), {"SW"}).at(0, 2, 1), taps.at(2, 2, 1));
}

TEST(ImageWriter, NamesChannelsInTheOrderOfTheirPlanes) {
  const Scratch scratch;
  const Image image = test::noise_image(4, 4, 12, 5);
  write_image(scratch.path("f.exr"), image.view(), QUELL_FEATURES, {false, {}, {}});
  const auto names = ImageFile(scratch.path("f.exr")).channel_names();
  EXPECT_EQ(names, channel_names(QUELL_FEATURES, 12));
  EXPECT_TRUE(same_bits(read_channels(scratch.path("f.exr"), names), image));
}

TEST(ImageWriter, KeepsMetadata) {
  const Scratch scratch;
  write_image(scratch.path("m.exr"), test::constant_image(2, 2, 3, 1).view(), QUELL_RADIANCE,
              {true, {}, {{"quell/graph", "svgf"}}});
  const auto in = OIIO::ImageInput::open(scratch.path("m.exr"));
  ASSERT_TRUE(in);
  EXPECT_EQ(in->spec().get_string_attribute("quell/graph"), "svgf");
  EXPECT_EQ(in->spec().get_string_attribute("compression"), "zip");
}

TEST(ImageWriter, LeavesTheTimeOut) {
  const Scratch scratch;
  for (const char* name : {"t.exr", "t.png"}) {
    write_image(scratch.path(name), test::constant_image(2, 2, 3, 1).view(), QUELL_RADIANCE);
    const auto in = OIIO::ImageInput::open(scratch.path(name));
    ASSERT_TRUE(in) << name;
    EXPECT_EQ(in->spec().get_string_attribute("DateTime"), "") << name;
  }
}

TEST(ImageWriter, EncodesPngForTheEye) {
  const Scratch scratch;
  Image image = test::constant_image(4, 1, 3, 0.0f);
  for (int c = 0; c < 3; ++c) image.at(c, 1, 0) = 1.0f, image.at(c, 2, 0) = 5.0f, image.at(c, 3, 0) = 0.2140411f;
  write_image(scratch.path("a.png"), image.view(), QUELL_RADIANCE);
  const Image back = read_channels(scratch.path("a.png"), {"R", "G", "B"});
  EXPECT_EQ(back.at(0, 0, 0), 0.0f);
  EXPECT_EQ(back.at(0, 1, 0), 1.0f);
  EXPECT_EQ(back.at(0, 2, 0), 1.0f);
  EXPECT_NEAR(back.at(0, 3, 0), 0.5f, 0.5f / 255);  // sRGB 0.5 is linear 0.2140411
  EXPECT_EQ(ImageFile(scratch.path("a.png")).encoding(0).curve, ColorEncoding::Curve::srgb);
  write_image(scratch.path("d.png"), image.view(), QUELL_DISPLAY);
  EXPECT_NEAR(read_channels(scratch.path("d.png"), {"R"}).at(0, 3, 0), 0.2140411f, 0.5f / 255);
}

TEST(ImageWriter, RefusesWhatItCannotWrite) {
  const Scratch scratch;
  const Image image = test::constant_image(2, 2, 1, 1);
  EXPECT_EQ(failure(Exit::usage, [&] { write_image("out/a.tga", image.view(), QUELL_DEPTH); }),
            "cannot write 'out/a.tga': the name must end in .exr or .png");
  EXPECT_EQ(failure(Exit::usage, [&] { write_image("a.png", image.view(), QUELL_DEPTH); }),
            "cannot write 'a.png': PNG shows radiance, albedo, display and normal, not depth; write .exr");
  std::ofstream(scratch.path("file")) << "x";
  EXPECT_EQ(failure(Exit::resources, [&] { write_image(scratch.path("file/a.exr"), image.view(), QUELL_DEPTH); }),
            "cannot make the folder of '" + scratch.path("file/a.exr") + "': Not a directory");
  std::filesystem::create_directory(scratch.path("folder.exr"));
  EXPECT_EQ(failure(Exit::resources, [&] { write_image(scratch.path("folder.exr"), image.view(), QUELL_DEPTH); }),
            "cannot write '" + scratch.path("folder.exr") + "': Is a directory");
}

TEST(ImageWriter, MakesFoldersAndLeavesNothingElse) {
  const Scratch scratch;
  write_image(scratch.path("a/b/c.exr"), test::constant_image(2, 2, 1, 1).view(), QUELL_DEPTH);
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scratch.folder()))
    files += entry.is_regular_file();
  EXPECT_EQ(files, 1);
}

TEST(ImageWriter, LeavesNoPartOfAFileWhenTheDiskIsFull) {
  const Scratch scratch;
  write_image(scratch.path("a.exr"), test::constant_image(2, 2, 1, 1).view(), QUELL_DEPTH);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string text = failure(Exit::resources, [&] {
    write_image(scratch.path("a.exr"), test::noise_image(64, 64, 1, 1).view(), QUELL_DEPTH);
  });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(text, "cannot write '" + scratch.path("a.exr") + "': File too large");
  EXPECT_EQ(read_channels(scratch.path("a.exr"), {"Z"}).at(0, 1, 1), 1.0f);  // the old file is whole
  const auto entries = std::filesystem::directory_iterator(scratch.folder());
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
}

TEST(TemporaryFile, IsRemovedUnlessCommitted) {
  const Scratch scratch;
  const auto count = [&] {
    const auto entries = std::filesystem::directory_iterator(scratch.folder());
    return std::distance(begin(entries), end(entries));
  };
  { TemporaryFile file(scratch.path("a")); }
  EXPECT_EQ(count(), 0);
  TemporaryFile file(scratch.path("a"));
  EXPECT_EQ(count(), 1);
  remove_temporaries();
  EXPECT_EQ(count(), 0);
}

}  // namespace
}  // namespace quell::test
