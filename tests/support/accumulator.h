// A graph whose history can be told from its output, over frames whose numbers can be foretold: what tests of runs are
// written with.
#pragma once

#include "core/graph/graph.h"
#include "core/image/image.h"
#include "core/report/error.h"
#include "core/run/executor.h"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace quell::test {

// A node of type sum (of now and before, with 1 in the second output where before has no past), blur (of rows; its
// parameters are radius and step) or fails (in row at_row, from frame 3 on).
GraphNode make(const char* name, const char* type, std::vector<std::vector<Wire>> in);
constexpr Source input(int port = 0) { return {Source::kInput, port}; }

// total = a + total@-1: the sum of all frames so far.
Graph accumulator();

// Frame f holds f + x / 1000 + y / 7.
class Frames : public FrameSource {
 public:
  Frames(std::int64_t first, std::int64_t last) {
    for (auto f = first; f <= last; ++f) frames_.push_back(f);
  }
  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t f) const override { return f == frames_[0] || declared_cut(f); }
  bool declared_cut(std::int64_t f) const override { return f == cut; }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t f, std::span<const std::string> r) override {
    return std::vector<quell_shape>(r.size(), quell_shape{f >= wide_from ? 2 * width : width, height, 1});
  }
  void read(std::int64_t f, std::span<const std::string>, std::span<const quell_image> into) override {
    if (f == broken) throw Error(Exit::input, "frame is broken");
    for (const auto& image : into)
      for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
          image.plane[0][y * image.pitch + x] = float(f) + float(x) / 1000 + float(y) / 7;
  }
  std::map<std::string, Repairs> repairs() const override { return {}; }

  int width = 37, height = 101;
  std::int64_t cut = -1, wide_from = 1 << 20, broken = -1;

 private:
  std::vector<std::int64_t> frames_;
  std::map<std::string, int> roles_{{"a", QUELL_SCALAR}};
};

class Keep : public FrameSink {
 public:
  void write(std::int64_t frame, std::span<const quell_image> outputs) override {
    auto& kept = frames.emplace_back(frame, std::vector<Image>()).second;
    for (const auto& o : outputs) {
      Image copy(o.width, o.height, o.channels);
      for (int c = 0; c < o.channels; ++c)
        for (int y = 0; y < o.height; ++y) std::copy_n(o.plane[c] + y * o.pitch, o.width, copy.row(c, y));
      kept.push_back(std::move(copy));
    }
  }
  float at(std::size_t i, int output, int x, int y) const { return frames[i].second[std::size_t(output)].at(0, x, y); }
  std::vector<std::pair<std::int64_t, std::vector<Image>>> frames;
};

bool same(const Image&, const Image&);  // in shape and bits

}  // namespace quell::test
