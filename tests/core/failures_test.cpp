// Runs in which something fails while other frames are read, filtered and written: one error comes out, always the same
// one, and what was done before it is whole.
#include "core/image/image.h"
#include "core/plugin/registry.h"
#include "core/report/error.h"
#include "core/run/executor.h"
#include "core/sequence/image_file.h"
#include "core/sequence/image_writer.h"
#include "tests/support/add_type.h"
#include "tests/support/scratch.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <quell/node.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <random>
#include <set>
#include <thread>

namespace quell::test {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 6;

// Twice the image, until a row of a frame.
struct Trips {
  In<Scalar> image;
  Out<Scalar> out;
  int frame = 0, row = 0, other_row = 0;
  void describe(Describe& d) {
    d.summary("Fails.");
    d.in(image, "image", "A.");
    d.out(out, "image", "Twice A.");
    d.param(frame, "frame", "At which it fails.");
    d.param(row, "row", "At which it fails.");
    d.param(other_row, "other_row", "And this one.");
  }
  void run(const Tile& t) const {
    std::this_thread::sleep_for(std::chrono::microseconds((7 * t.y0 + 5 * int(t.frame)) % 4 * 40));
    if (t.frame == frame)
      for (const int r : {std::min(row, other_row), std::max(row, other_row)})
        if (t.y0 <= r && r < t.y1) throw std::runtime_error(fmt::format("row {} is unlucky", r));
    for (int y = t.y0; y < t.y1; ++y)
      for (int x = t.x0; x < t.x1; ++x) t.row(out, 0, y)[x] = 2 * t.row(image, 0, y)[x];
  }
};

// What goes wrong in a run, and how it runs.
struct Course {
  int width = 0, height = 0;
  int read_fails = 0, node_fails = 0, write_fails = 0;  // frames, counted from 1; 0: none
  int row = 0, other_row = 0;
  RunOptions options;

  // What a run of one thing after the other would meet first.
  std::string error() const {
    for (int f = 1; f <= kFrames; ++f) {
      if (f == read_fails) return fmt::format("cannot read {}", f);
      if (f == node_fails) {
        const int first = std::min(row, other_row), top = first / options.band_rows * options.band_rows;
        return fmt::format("trips (trips), frame {}, rows {}-{}: row {} is unlucky", f, top,
                           std::min(height, top + options.band_rows) - 1, first);
      }
      if (f == write_fails) return fmt::format("cannot write {}", f);
    }
    return "";
  }
  // Frames before it.
  int whole() const {
    int least = kFrames + 1;
    for (const int f : {read_fails, node_fails, write_fails})
      if (f) least = std::min(least, f);
    return least - 1;
  }
};

float value(std::int64_t frame, int x, int y) { return float(frame) + float(x) / 64 + float(y) / 2048; }

class Frames : public FrameSource {
 public:
  explicit Frames(const Course& course) : course_(course) {
    for (int f = 1; f <= kFrames; ++f) frames_.push_back(f);
  }
  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t f) const override { return f == 1; }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t, std::span<const std::string>) override {
    return {{course_.width, course_.height, 1}};
  }
  void read(std::int64_t f, std::span<const std::string>, std::span<const quell_image> into) override {
    if (f == course_.read_fails) throw Error(Exit::input, fmt::format("cannot read {}", f));
    for (int y = 0; y < course_.height; ++y)
      for (int x = 0; x < course_.width; ++x) into[0].plane[0][y * into[0].pitch + x] = value(f, x, y);
  }
  std::map<std::string, Repairs> repairs() const override { return {}; }

 private:
  const Course& course_;
  std::vector<std::int64_t> frames_;
  std::map<std::string, int> roles_{{"a", QUELL_SCALAR}};
};

class Files : public FrameSink {
 public:
  Files(const Course& course, std::string folder) : course_(course), folder_(std::move(folder)) {}
  void write(std::int64_t f, std::span<const quell_image> outputs) override {
    if (f == course_.write_fails) throw std::runtime_error(fmt::format("cannot write {}", f));
    write_image(fmt::format("{}/{}.exr", folder_, f), outputs[0], QUELL_SCALAR, {.half = false});
  }

 private:
  const Course& course_;
  std::string folder_;
};

Graph graph_of(const Course& course) {
  static Registry registry({});
  static const bool added = add_type<Trips>(registry, "trips");
  EXPECT_TRUE(added);
  Graph g;
  g.inputs = {{"a", QUELL_SCALAR, false}};
  g.nodes.push_back({"trips", Instance(*registry.find("trips")), {{{{Source::kInput, 0}, 0, {}}}}, {QUELL_SCALAR}, {}});
  auto& instance = g.nodes[0].instance;
  instance.set_int(0, course.node_fails), instance.set_int(1, course.row), instance.set_int(2, course.other_row);
  g.outputs = {{"out", {{0, 0}, 0, {}}, QUELL_SCALAR, false}};
  return g;
}

void expect_whole(const std::string& path, const Course& course, int frame) {
  ImageFile file(path);
  ASSERT_EQ(file.size(0).width, course.width);
  ASSERT_EQ(file.size(0).height, course.height);
  Image image(course.width, course.height, 1);
  const ChannelRead read{0, image.row(0, 0)};
  file.read({&read, 1}, image.pitch());
  for (int y = 0; y < course.height; ++y)
    for (int x = 0; x < course.width; ++x) ASSERT_EQ(image.at(0, x, y), 2 * value(frame, x, y)) << path;
}

void expect_one_end(const Course& course) {
  const test::Scratch scratch;
  const auto graph = graph_of(course);
  Frames source(course);
  Files sink(course, scratch.folder());
  std::string error;
  try {
    const auto report = run_graph(graph, source, sink, course.options);
    EXPECT_EQ(report.frames, std::size_t(kFrames));
  } catch (const std::exception& e) {
    error = e.what();
    if (const auto* known = dynamic_cast<const Error*>(&e); known && error.starts_with("trips")) {
      EXPECT_EQ(known->exit(), Exit::plugin);
    }
  }
  EXPECT_EQ(error, course.error());
  std::set<std::string> expected, found;
  for (int f = 1; f <= course.whole(); ++f) expected.insert(fmt::format("{}.exr", f));
  for (const auto& entry : fs::directory_iterator(scratch.folder())) found.insert(entry.path().filename().string());
  ASSERT_EQ(found, expected);
  for (int f = 1; f <= course.whole(); ++f) expect_whole(scratch.path(fmt::format("{}.exr", f)), course, f);
}

// Threads that keep the machine busy, so that those of a run are stopped anywhere.
class Load {
 public:
  Load() {
    for (unsigned i = 0; i < std::max(2u, std::thread::hardware_concurrency()); ++i)
      threads_.emplace_back([](const std::stop_token& stop) {
        while (!stop.stop_requested())
          if (std::random_device()() % 8 == 0) std::this_thread::sleep_for(std::chrono::microseconds(50));
      });
  }

 private:
  std::vector<std::jthread> threads_;
};

class Failures : public testing::TestWithParam<const char*> {};

// The parameter names what may fail.
TEST_P(Failures, EndTheRunWithTheFirstErrorAndWholeFrames) {
  const std::string what = GetParam();
  const auto named = [&](const char* word) { return what.find(word) != std::string::npos; };
  const Load load;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    const auto below = [&](int n) { return int(random() % unsigned(n)); };
    Course course;
    course.width = 1 + below(40), course.height = 1 + below(60);
    const int frame = 1 + below(kFrames);
    // Close to each other, so that they are in flight at once.
    const auto near = [&] { return std::clamp(frame - 1 + below(3), 1, kFrames); };
    if (named("Node")) course.node_fails = frame;
    if (named("Read")) course.read_fails = near();
    if (named("Write")) course.write_fails = near();
    course.row = below(course.height), course.other_row = below(course.height);
    course.options.threads = 1 + below(4), course.options.band_rows = 1 + below(9);
    course.options.overlap = below(8) != 0;
    expect_one_end(course);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Failures,
                         testing::Values("Nothing", "Node", "NodeAndRead", "NodeAndWrite", "ReadAndWrite",
                                         "NodeReadAndWrite"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace quell::test
