// Changes of images, and runs over synthetic frames that went through them.
#include "tests/support/altered_frames.h"

#include "core/bench/synthetic_source.h"
#include "core/run/executor.h"

#include <quell/types.h>

#include <algorithm>
#include <utility>

namespace quell::test {

namespace {

// Bits 0-8 are a 3×3, row by row.
std::uint32_t mirrored_mask(std::uint32_t mask, bool horizontal) {
  std::uint32_t out = mask & ~0x1FFu;
  for (unsigned i = 0; i < 9; ++i) {
    const unsigned x = i % 3, y = i / 3, from = horizontal ? y * 3 + 2 - x : (2 - y) * 3 + x;
    out |= (mask >> from & 1u) << i;
  }
  return out;
}

class Frames : public SyntheticSource {
 public:
  Frames(const Graph& graph, const SyntheticRun& run)
      : SyntheticSource(graph, run.width, run.height, int(run.last) + 1), run_(run) {
    for (auto f = run.first; f <= run.last; ++f) numbers_.push_back(f);
  }
  const std::vector<std::int64_t>& frames() const override { return numbers_; }
  bool cut_before(std::int64_t f) const override { return f == run_.first || f == run_.cut; }
  bool declared_cut(std::int64_t f) const override { return f == run_.cut; }
  void read(std::int64_t frame, std::span<const std::string> names, std::span<const quell_image> into) override {
    SyntheticSource::read(frame, names, into);
    if (!run_.alter) return;
    for (std::size_t i = 0; i < names.size(); ++i) {
      Image image(into[i].width, into[i].height, into[i].channels);
      for (int c = 0; c < image.channels(); ++c)
        for (int y = 0; y < image.height(); ++y)
          std::copy_n(into[i].plane[c] + y * into[i].pitch, image.width(), image.row(c, y));
      const int type = roles().at(names[i]);
      image = run_.alter(image, type, frame);
      for (int c = 0; c < image.channels(); ++c)
        for (int y = 0; y < image.height(); ++y)
          std::copy_n(image.row(c, y), image.width(), into[i].plane[c] + y * into[i].pitch);
    }
  }

 private:
  const SyntheticRun& run_;
  std::vector<std::int64_t> numbers_;
};

class Keep : public FrameSink {
 public:
  void write(std::int64_t frame, std::span<const quell_image> outputs) override {
    for (const auto& o : outputs) {
      auto& copy = images[frame].emplace_back(o.width, o.height, o.channels);
      for (int c = 0; c < o.channels; ++c)
        for (int y = 0; y < o.height; ++y) std::copy_n(o.plane[c] + y * o.pitch, o.width, copy.row(c, y));
    }
  }
  std::map<std::int64_t, std::vector<Image>> images;
};

}  // namespace

Image mirrored(const Image& image, int type, bool horizontal) {
  if (type_info(type)->storage != Storage::pixels) return image.copy();
  Image out(image.shape());
  const int width = image.width(), height = image.height(), axis = horizontal ? 0 : 1;
  for (int c = 0; c < image.channels(); ++c) {
    // Of taps, the weights of the two sides change places.
    const int from = type == QUELL_TAPS && c < 4 ? c ^ (horizontal ? 1 : 2) : c;
    const bool negate = (type == QUELL_MOTION || type == QUELL_SLOPE) && c == axis;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const int u = horizontal ? width - 1 - x : x, v = horizontal ? y : height - 1 - y;
        const auto bits = image.bits(from, v)[u];
        if (type == QUELL_TAPS && c == 4)
          out.bits(c, y)[x] = mirrored_mask(bits, horizontal);
        else
          out.bits(c, y)[x] = negate ? bits ^ 0x80000000u : bits;
      }
  }
  return out;
}

// World to screen with x' = width - x or y' = height - y, after the division by w.
Image mirrored_camera(const Image& camera, bool horizontal, float extent) {
  Image out = camera.copy();
  const int row = horizontal ? 0 : 4;
  for (int i = 0; i < 4; ++i) out.at(0, row + i, 1) = extent * camera.at(0, 12 + i, 1) - camera.at(0, row + i, 1);
  return out;
}

Image brightened(const Image& image, int type, float scale) {
  Image out = image.copy();
  const auto multiply = [&](int channel, float by) {
    for (int y = 0; y < out.height(); ++y)
      for (int x = 0; x < out.width(); ++x) out.at(channel, x, y) *= by;
  };
  if (type == QUELL_RADIANCE)
    for (int c = 0; c < 3; ++c) multiply(c, scale);
  if (type == QUELL_MOMENTS) multiply(0, scale), multiply(1, scale * scale);
  if (type == QUELL_VARIANCE) multiply(0, scale * scale);
  return out;
}

std::map<std::int64_t, std::vector<Image>> run_synthetic(const Graph& graph, const SyntheticRun& run) {
  Frames source(graph, run);
  Keep sink;
  run_graph(graph, source, sink, {});
  return std::move(sink.images);
}

}  // namespace quell::test
