// References that are kept: the bits that were made, made once.
#include "core/lab/kept_source.h"

#include "core/image/image.h"
#include "tests/support/read_role.h"
#include "tests/support/run_node.h"
#include "tests/support/scratch.h"

#include <gtest/gtest.h>
#include <quell/types.h>

#include <filesystem>

namespace quell::test {
namespace {

// Numbers that halves cannot hold, and counts how often it was asked.
class Made : public FrameSource {
 public:
  Made(int width, int* asked) : width_(width), asked_(asked) {}
  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t frame) const override { return frame == 3; }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t, std::span<const std::string> roles) override {
    return std::vector<quell_shape>(roles.size(), {width_, 3, 3});
  }
  void read(std::int64_t frame, std::span<const std::string>, std::span<const quell_image> into) override {
    ++*asked_;
    for (const auto& image : into)
      for (int c = 0; c < image.channels; ++c)
        for (int y = 0; y < image.height; ++y)
          for (int x = 0; x < image.width; ++x)
            image.plane[c][y * image.pitch + x] = 1e6f / float(7 + frame + c * 11 + y * 5 + x);
  }
  std::map<std::string, Repairs> repairs() const override { return {}; }

 private:
  std::vector<std::int64_t> frames_{3, 4};
  std::map<std::string, int> roles_{{"color", QUELL_RADIANCE}};
  int width_;
  int* asked_;
};

Image frame_of(FrameSource& source, std::int64_t frame) { return read_role(source, frame, "color"); }

TEST(KeptSource, MakesAFrameOnceAndGivesItsBitsEverAfter) {
  const Scratch scratch;
  int asked = 0, asked_again = 0;
  Made made(5, &asked_again);
  for (int run = 0; run < 2; ++run) {
    KeptSource kept(std::make_unique<Made>(5, &asked), "color", scratch.path("kept"), {{"source.scene", "0123"}});
    for (const std::int64_t frame : {3, 4}) EXPECT_TRUE(same_bits(frame_of(kept, frame), frame_of(made, frame)));
    EXPECT_TRUE(kept.cut_before(3));
  }
  EXPECT_EQ(asked, 2);
  std::filesystem::remove(scratch.path("kept") + "/frame.0004.exr");
  KeptSource kept(std::make_unique<Made>(5, &asked), "color", scratch.path("kept"), {{"source.scene", "0123"}});
  EXPECT_TRUE(same_bits(frame_of(kept, 4), frame_of(made, 4)));
  EXPECT_EQ(asked, 3);
}

TEST(KeptSource, TellsWhatKeptFramesWereMadeFrom) {
  const Scratch scratch;
  int asked = 0;
  for (int run = 0; run < 2; ++run) {
    KeptSource kept(std::make_unique<Made>(5, &asked), "color", scratch.path("kept"), {{"source.scene", "0123"}});
    std::vector<FileRead> told;
    kept.watch_files([&](const FileRead& read) { told.push_back(read); });
    frame_of(kept, 4);
    // The source tells for itself when it is asked; this one has nothing to tell.
    ASSERT_EQ(told.size(), std::size_t(run));
    if (run == 0) continue;
    EXPECT_EQ(told[0].frame, 4);
    EXPECT_EQ(told[0].name, "source.scene");
    EXPECT_EQ(told[0].hash, "0123");
    EXPECT_EQ(told[0].roles, std::vector<std::string>{"color"});
  }
  EXPECT_EQ(asked, 1);
}

TEST(KeptSource, MakesAnewWhatHasAnotherSize) {
  const Scratch scratch;
  int asked = 0;
  KeptSource small(std::make_unique<Made>(5, &asked), "color", scratch.path("kept"), {{"source.scene", "0123"}});
  frame_of(small, 3);
  KeptSource large(std::make_unique<Made>(6, &asked), "color", scratch.path("kept"), {{"source.scene", "0123"}});
  EXPECT_EQ(frame_of(large, 3).width(), 6);
  EXPECT_EQ(asked, 2);
}

}  // namespace
}  // namespace quell::test
