// The rules that every node keeps.
#include "tests/contract/checks.h"

#include "tests/contract/guarded.h"
#include "tests/contract/poison.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <limits>
#include <stdexcept>
#include <thread>
#include <utility>

namespace quell::test {

namespace {

constexpr std::int64_t kFrame = 7;

Rect whole(const quell_shape& s) { return {0, 0, s.width, s.height}; }

std::vector<Rect> tiles_of(const quell_shape& s, int rows, int columns) {
  rows = rows ? rows : s.height;
  columns = columns ? columns : s.width;
  std::vector<Rect> tiles;
  for (int y = 0; y < s.height; y += rows)
    for (int x = 0; x < s.width; x += columns)
      tiles.push_back({x, y, std::min(x + columns, s.width), std::min(y + rows, s.height)});
  return tiles;
}

std::string shown(const Rect& r) { return fmt::format("tile [{}, {}) × [{}, {})", r.x0, r.x1, r.y0, r.y1); }

void run_whole(const Bound& bound, Outputs& out) { bound.run(whole(bound.extent()), kFrame, out.views()); }

std::string misplaced(const Outputs& out, const Rect& tile) {
  for (std::size_t o = 0; o < out.images.size(); ++o) {
    if (!out.images[o]) continue;
    const bool all = !out.pixels[o] && tile.holds(0, 0);
    const Rect none{0, 0, 0, 0};
    const auto text = out.images[o]->misplaced(out.pixels[o] ? tile : none, all);
    if (!text.empty()) return fmt::format("{}: {}", out.names[o], text);
  }
  return "";
}

}  // namespace

std::string breaks_when_run(const Use& use) {
  const Bound bound(use);
  Outputs out(use, bound);
  for (std::size_t o = 0; o < out.images.size(); ++o)
    if (out.images[o] && out.pixels[o] &&
        (bound.shapes()[o].width != bound.extent().width || bound.shapes()[o].height != bound.extent().height))
      return fmt::format("{}: outputs differ in size", out.names[o]);
  run_whole(bound, out);
  const auto text = misplaced(out, whole(bound.extent()));
  return text.empty() ? not_finite(out) : text;
}

std::string breaks_in_tiles(const Use& use, int rows, int columns) {
  const Bound bound(use);
  Outputs expected(use, bound), out(use, bound);
  run_whole(bound, expected);
  for (const auto& tile : tiles_of(bound.extent(), rows, columns)) {
    Use poisoned = use.copy();
    poison(poisoned, tile, bound.extent());
    const Bound alone(poisoned);
    out.reset();
    alone.run(tile, kFrame, out.views());
    auto text = misplaced(out, tile);
    if (text.empty()) text = difference(expected, out, tile);
    if (!text.empty()) return fmt::format("{}: {}", shown(tile), text);
  }
  return "";
}

std::string breaks_in_threads(const Use& use, int threads) {
  const Bound bound(use);
  Outputs expected(use, bound), out(use, bound);
  run_whole(bound, expected);
  const auto tiles = tiles_of(bound.extent(), 3, 0);
  for (int round = 0; round < 2; ++round) {
    out.reset();
    const auto views = out.views();
    std::atomic<std::size_t> next = 0;
    std::string error;
    std::atomic<bool> failed = false;
    const auto work = [&] {
      for (std::size_t i; (i = next++) < tiles.size();) try {
          bound.run(tiles[i], kFrame, views);
        } catch (const std::exception& e) {
          if (!failed.exchange(true)) error = e.what();
        }
    };
    std::vector<std::thread> team;
    for (int t = 0; t < threads; ++t) team.emplace_back(work);
    for (auto& t : team) t.join();
    if (failed) return "a tile failed where the whole image did not: " + error;
    if (const auto text = difference(expected, out, whole(bound.extent())); !text.empty()) return text;
  }
  return "";
}

std::string breaks_on_non_finite(const Use& use) {
  const Bound bound(use);
  const auto extent = bound.extent();
  Outputs expected(use, bound), out(use, bound);
  run_whole(bound, expected);
  Use broken = use.copy();
  std::string text;
  const float inf = std::numeric_limits<float>::infinity();
  each_image(broken, {}, [&](Image& image, int type, const quell_reach& reach) {
    const auto* info = type_info(type);
    if (!is_pixels(type) || info->integer || image.width() != extent.width || image.height() != extent.height) return;
    const int channels = type == QUELL_TAPS ? 4 : image.channels();
    for (const float value : {std::nanf(""), inf, -inf})
      for (int c = 0; c < channels && text.empty(); ++c) {
        const int x = image.width() / 2, y = image.height() / 2;
        const float kept = std::exchange(image.at(c, x, y), value);
        out.reset();
        const Bound again(broken);
        run_whole(again, out);
        image.at(c, x, y) = kept;
        if (reach.anywhere) continue;
        const Rect touched{x - reach.right, y - reach.down, x + reach.left + 1, y + reach.up + 1};
        const int w = extent.width, h = extent.height;
        for (const Rect& r : {Rect{0, 0, w, std::clamp(touched.y0, 0, h)}, Rect{0, std::clamp(touched.y1, 0, h), w, h},
                              Rect{0, 0, std::clamp(touched.x0, 0, w), h}, Rect{std::clamp(touched.x1, 0, w), 0, w, h}})
          if (text.empty()) text = difference(expected, out, r);
        if (!text.empty()) text = fmt::format("{} in a {} at ({}, {}): {}", value, type_name(type), x, y, text);
      }
  });
  return text;
}

}  // namespace quell::test
