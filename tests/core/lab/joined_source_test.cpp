// Frames from several sources: each role from the source that gives it.
#include "core/lab/joined_source.h"

#include "core/image/image.h"
#include "core/report/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <set>

namespace quell {
namespace {

// Every role of frame f holds base + f.
class Counting : public FrameSource {
 public:
  Counting(std::vector<std::int64_t> frames, float base, std::map<std::string, int> roles)
      : frames_(std::move(frames)), base_(base), roles_(std::move(roles)) {}
  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t frame) const override { return frame == frames_.front(); }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t, std::span<const std::string> roles) override {
    return std::vector<quell_shape>(roles.size(), quell_shape{int(base_), 1, 1});
  }
  void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) override {
    for (std::size_t i = 0; i < roles.size(); ++i) {
      EXPECT_TRUE(roles_.contains(roles[i]));
      into[i].plane[0][0] = base_ + float(frame);
    }
  }
  std::map<std::string, Repairs> repairs() const override { return {{"color", {std::int64_t(base_), 0}}}; }
  void refuse_non_finite(std::span<const std::string> roles) override { refused.assign(roles.begin(), roles.end()); }
  std::string description(const std::filesystem::path&, std::span<const std::string> roles) const override {
    return fmt::format(R"({{"{}":"{}"}})", base_, fmt::join(roles, " "));
  }
  void watch_files(FileWatcher watcher) override {
    for (const auto frame : frames_) watcher({frame, fmt::format("{}.exr", base_), "hash", {"color", "motion"}});
  }

  std::vector<std::string> refused;

 private:
  std::vector<std::int64_t> frames_;
  float base_;
  std::map<std::string, int> roles_;
};

std::unique_ptr<FrameSource> counting(std::vector<std::int64_t> frames, float base) {
  return std::make_unique<Counting>(std::move(frames), base,
                                    std::map<std::string, int>{{"color", QUELL_RADIANCE}, {"motion", QUELL_MOTION}});
}

std::vector<JoinedSource::Part> parts(std::vector<std::int64_t> frames_of_second, bool still = false) {
  std::vector<JoinedSource::Part> all(2);
  all[0] = {"A", counting({3, 4, 5}, 100), {{"image", "color"}}, false};
  all[1] = {"B", counting(std::move(frames_of_second), 200), {{"reference", "color"}, {"motion", "motion"}}, still};
  return all;
}

TEST(JoinedSource, EachRoleFromItsSource) {
  JoinedSource joined(parts({2, 3, 4, 5, 6}));
  EXPECT_EQ(joined.frames(), (std::vector<std::int64_t>{3, 4, 5}));
  EXPECT_TRUE(joined.cut_before(3));
  EXPECT_EQ(joined.roles(), (std::map<std::string, int>{
                                {"image", QUELL_RADIANCE}, {"reference", QUELL_RADIANCE}, {"motion", QUELL_MOTION}}));
  const std::vector<std::string> roles{"motion", "image", "reference"};
  const auto shapes = joined.shapes(4, roles);
  EXPECT_EQ(shapes[0].width, 200);
  EXPECT_EQ(shapes[1].width, 100);
  Image a(1, 1, 1), b(1, 1, 1), c(1, 1, 1);
  const std::vector<quell_image> into{a.view(), b.view(), c.view()};
  joined.read(4, roles, into);
  EXPECT_EQ(a.at(0, 0, 0), 204);
  EXPECT_EQ(b.at(0, 0, 0), 104);
  EXPECT_EQ(c.at(0, 0, 0), 204);
  EXPECT_EQ(joined.repairs().at("reference").non_finite, 200);
}

TEST(JoinedSource, TellsEachSourceWhatItMustNotRepair) {
  auto all = parts({3, 4, 5});
  const auto &first = static_cast<Counting&>(*all[0].source), &second = static_cast<Counting&>(*all[1].source);
  JoinedSource joined(std::move(all));
  const std::vector<std::string> roles{"image", "reference"};
  joined.refuse_non_finite(roles);
  EXPECT_EQ(first.refused, std::vector<std::string>{"color"});
  EXPECT_EQ(second.refused, std::vector<std::string>{"color"});
}

TEST(JoinedSource, AStillServesAllFrames) {
  JoinedSource joined(parts({0}, true));
  Image a(1, 1, 1);
  const std::vector<quell_image> into{a.view()};
  joined.read(5, std::vector<std::string>{"reference"}, into);
  EXPECT_EQ(a.at(0, 0, 0), 200);
}

TEST(JoinedSource, SparseFramesReadAsMissing) {
  auto some = parts({4});
  some[1].sparse = {4};
  JoinedSource joined(std::move(some));
  EXPECT_TRUE(joined.has(4, "reference"));
  EXPECT_FALSE(joined.has(5, "reference"));
  EXPECT_TRUE(joined.has(5, "image"));
  const std::vector<std::string> roles{"reference"};
  EXPECT_EQ(joined.shapes(5, roles)[0].width, 200);
  Image a(1, 1, 1);
  a.fill(9);
  const std::vector<quell_image> into{a.view()};
  joined.read(3, roles, into);
  EXPECT_EQ(a.at(0, 0, 0), 0);
  joined.read(4, roles, into);
  EXPECT_EQ(a.at(0, 0, 0), 204);
}

TEST(JoinedSource, IsDescribedByTheSourcesThatAreRead) {
  auto renamed = parts({3, 4, 5});
  renamed[0].roles = {{"color", "color"}};
  const JoinedSource joined(std::move(renamed));
  const auto described = [&](std::vector<std::string> roles) { return joined.description("", roles); };
  // One that needs no other and no other names stands for itself.
  EXPECT_EQ(described({"color"}), R"({"100":"color"})");
  // The first tells which frames there are, even where nothing is read of it.
  EXPECT_EQ(described({"reference"}), R"({"quell_joined":1,"parts":[{"roles":{},"sequence":{"100":"color"}},)"
                                      R"({"roles":{"reference":"color"},"sequence":{"200":"color"}}]})");
  EXPECT_EQ(described({"color", "motion"}),
            R"({"quell_joined":1,"parts":[{"roles":{"color":"color"},"sequence":{"100":"color"}},)"
            R"({"roles":{"motion":"motion"},"sequence":{"200":"motion"}}]})");
  auto some = parts({4}, false);
  some[1].sparse = {4};
  EXPECT_EQ(JoinedSource(std::move(some)).description("", std::vector<std::string>{"image", "reference"}),
            R"({"quell_joined":1,"parts":[{"roles":{"image":"color"},"sequence":{"100":"color"}},)"
            R"({"roles":{"reference":"color"},"frames":"4","sequence":{"200":"color"}}]})");
  EXPECT_EQ(JoinedSource(parts({0}, true)).description("", std::vector<std::string>{"reference"}),
            R"({"quell_joined":1,"parts":[{"roles":{},"sequence":{"100":"color"}},)"
            R"({"roles":{"reference":"color"},"still":true,"sequence":{"200":"color"}}]})");
}

TEST(JoinedSource, TellsOfFilesUnderItsOwnNames) {
  JoinedSource joined(parts({3, 4, 5}));
  std::set<std::string> told;
  joined.watch_files([&](const FileRead& read) {
    told.insert(fmt::format("{} {} {}", read.name, read.hash, fmt::join(read.roles, "+")));
  });
  EXPECT_EQ(told, (std::set<std::string>{"100.exr hash image", "motion, reference: 200.exr hash motion+reference"}));
}

TEST(JoinedSource, NamesTheFrameThatIsMissing) {
  try {
    JoinedSource joined(parts({3, 5}));
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.exit(), Exit::input);
    EXPECT_STREQ(e.what(), "B has no frame 4, which A has; --frames picks those that both have");
  }
}

TEST(JoinedSource, RefusesTwoSourcesOfOneRole) {
  auto both = parts({3, 4, 5});
  both[1].roles["image"] = "color";
  EXPECT_THROW(JoinedSource{std::move(both)}, Error);
}

}  // namespace
}  // namespace quell
