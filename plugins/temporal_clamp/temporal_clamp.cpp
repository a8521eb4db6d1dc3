// Pulls history into the range of the current frame's neighbourhood, so that what has changed does not linger.
#include <quell/node.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "temporal_clamp/temporal_clamp_kernels.h"

namespace {

using quell::PullRules;

struct TemporalClamp {
  quell::In<quell::Any> history;
  quell::In<quell::Any> current;
  quell::Out<quell::Any> clamped;
  int radius = 3;
  quell::Box box = quell::Box::sigma;
  float k = 1.0f;
  bool hold_center = false;
  quell::Pull pull = quell::Pull::clamp;
  quell::Space space = quell::Space::linear;
  bool compress = false;

  void describe(quell::Describe& d) {
    d.summary("Pulls reprojected history into the range that the current frame has around the pixel.");
    d.source(
        "As it stands: GAMES202 homework 5, temporal accumulation. box range: Karis 2014, High Quality Temporal "
        "Supersampling; pull clip adds his clip towards the centre. box sigma, pull clip, space ycocg: variance "
        "clipping, Salvi 2016, An Excursion in Temporal Supersampling.");
    d.in(history, "history", "Reprojected history.");
    d.in(current, "current", "This frame, filtered: the statistics of a noisy frame are too wide to catch anything.")
        .halo(radius);
    d.out(clamped, "image", "History within the range; what lies in it stays as it is, to the bit.").passes(history);
    d.param(radius, "radius", "Half-width of the neighbourhood, pixels.").range(1, 16);
    d.param(box, "box",
            "The range of each channel. sigma: mean ± k·sigma of the neighbourhood. range: its least and its largest "
            "value.",
            {"sigma", "range"});
    d.param(k, "k", "Half-width of the accepted range, standard deviations, of box sigma.").range(0, 1e6);
    d.param(hold_center, "hold_center", "Widen the range until it holds the current pixel itself.");
    d.param(pull, "pull",
            "clamp: each channel to the nearer end of its range. clip: all channels together, along the line to the "
            "middle of the box until they are in it, which keeps hue where clamp does not.",
            {"clamp", "clip"});
    d.param(space, "space",
            "What the channels of the box are. linear: those of the image. ycocg: luma and two differences of an RGB "
            "image, so that the box lies along its colours; the result is not below 0.",
            {"linear", "ycocg"});
    d.param(compress, "compress",
            "Take statistics and pull on the scale of ±log(1 + |x|), where a firefly does not widen the range for all "
            "around it.");
  }

  void shapes(const quell_spec& spec, quell_shape*) const {
    const int channels = spec.in[history.index].channels;
    if (space == quell::Space::ycocg && channels != 3)
      throw std::runtime_error("space ycocg takes images of three channels, RGB; 'history' has " +
                               std::to_string(channels) + ": use space linear");
  }

  void run(const quell::Tile& tile) const {
    const PullRules rules{box, pull, space, compress, hold_center};
    const int channels = tile[current].channels;
    const Surroundings around(*this, tile, rules);
    quell::WindowMemory memory(tile.x1 - tile.x0, radius);
    quell::WindowRange window{
        nullptr, around.pitch, tile[current].width, tile[current].height, radius, k, false, 0.0f, {}, nullptr, nullptr};
    memory.lend(window);
    const std::size_t reached = std::size_t(tile.x1 - tile.x0 + 2 * radius + 16);
    std::vector<float> extremes(2 * reached);
    float* const columns[2] = {extremes.data(), extremes.data() + reached};
    Rows low(tile, channels), high(tile, channels), converted(tile, channels), pulled(tile, channels);
    quell::PullRow row{rules,           channels, {}, low.at.data(), high.at.data(), {}, {}, converted.at.data(),
                       pulled.at.data()};
    std::vector<const float*> then(std::size_t(channels), nullptr), now = then;
    std::vector<float*> out(std::size_t(channels), nullptr);
    row.history = then.data(), row.current = now.data(), row.out = out.data();
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (std::size_t c = 0; c < out.size(); ++c) {
        window.plane = around.plane[c];
        window.low = low.at[c] + tile.x0, window.high = high.at[c] + tile.x0;
        box == quell::Box::sigma ? quell::window_sigmas(window, y, tile.x0, tile.x1)
                                 : quell::window_extremes(window, columns, y, tile.x0, tile.x1);
        then[c] = tile.row(history, int(c), y), now[c] = around.plane[c] + y * around.pitch;
        out[c] = tile.row(clamped, int(c), y);
      }
      quell::pull_history(row, tile.x0, tile.x1);
    }
  }

 private:
  // A row of each channel, as long as the tile is wide; `at` points at pixel x = 0.
  struct Rows {
    Rows(const quell::Tile& tile, int channels) {
      const std::ptrdiff_t stride = tile.x1 - tile.x0 + 16;
      memory.resize(std::size_t(stride * channels));
      for (int c = 0; c < channels; ++c) at.push_back(memory.data() + c * stride - tile.x0);
    }
    std::vector<float> memory;
    std::vector<float*> at;
  };

  // The current frame as far as the windows of the tile reach, in the space of the box: the image itself where that is
  // its own. Planes point at pixel (0, 0).
  struct Surroundings {
    Surroundings(const TemporalClamp& node, const quell::Tile& tile, const PullRules& rules) {
      const auto& now = tile[node.current];
      pitch = now.pitch;
      plane.assign(now.plane, now.plane + now.channels);
      if (!rules.converts()) return;
      const int left = std::max(tile.x0 - node.radius, 0), right = std::min(tile.x1 + node.radius, now.width);
      const int top = std::max(tile.y0 - node.radius, 0), bottom = std::min(tile.y1 + node.radius, now.height);
      pitch = right - left + 16;  // vectors read past the last pixel
      const std::ptrdiff_t size = pitch * (bottom - top);
      memory.resize(std::size_t(size * now.channels));
      std::vector<const float*> from(plane.size(), nullptr);
      std::vector<float*> to(plane.size(), nullptr);
      for (int y = top; y < bottom; ++y) {
        for (std::size_t c = 0; c < plane.size(); ++c) {
          from[c] = now.plane[c] + y * now.pitch;
          to[c] = memory.data() + std::ptrdiff_t(c) * size + (y - top) * pitch - left;
        }
        quell::convert_row(rules, now.channels, from.data(), to.data(), left, right);
      }
      for (std::size_t c = 0; c < plane.size(); ++c)
        plane[c] = memory.data() + std::ptrdiff_t(c) * size - top * pitch - left;
    }
    std::vector<float> memory;
    std::vector<const float*> plane;
    std::ptrdiff_t pitch;
  };
};

}  // namespace
QUELL_PLUGIN("temporal_clamp", TemporalClamp)
