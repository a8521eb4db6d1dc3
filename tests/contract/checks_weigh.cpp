// The rules that every weight node keeps.
#include "tests/contract/checks.h"
#include "tests/contract/guarded.h"
#include "tests/contract/poison.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace quell::test {

namespace {

constexpr int kRow = QUELL_SEGMENT;  // floats from one tap's exponents to the next
constexpr float kNever = 126.0f;     // from here on a weight is 0, whatever the exponent
constexpr float kBefore = 1.5f;      // what added exponents are added to

struct Offset {
  int dx, dy;
};

// The 24 taps around the centre of a 5×5 that is stretched by `step`, in mirrored pairs.
std::vector<Offset> offsets(int step) {
  std::vector<Offset> list;
  for (int dy = 0; dy <= 2; ++dy)
    for (int dx = -2; dx <= 2; ++dx)
      if (dy > 0 || dx > 0) {
        list.push_back({dx * step, dy * step});
        list.push_back({-dx * step, -dy * step});
      }
  return list;
}

// The exponents of one run, in memory of which every float starts untouched.
struct Exponents {
  std::vector<std::uint32_t> memory = std::vector<std::uint32_t>(QUELL_MAX_TAPS * kRow + 16, kUntouched);
  float* data() {
    const auto skip = (64 - reinterpret_cast<std::uintptr_t>(memory.data()) % 64) % 64 / sizeof(float);
    return reinterpret_cast<float*>(memory.data() + skip);
  }
};

struct Row {
  const Bound& bound;
  int width, y;
  std::vector<quell_tap> taps;
  bool paired;

  void weigh(int x, int n, bool store, float* exponent) const {
    const std::ptrdiff_t at = y * pitch_for(width) + x;
    const quell_run run{x, y, n, int(taps.size()), taps.data(), at, kRow, paired ? 1 : 0, store ? 1 : 0};
    bound.weigh(run, exponent);
  }
  bool inside(int tap, int x) const {
    const int q = x + taps[std::size_t(tap)].dx;
    return q >= 0 && q < width;
  }
};

Row row_of(const Bound& bound, int width, int height, int y, int step) {
  Row row{bound, width, y, {}, true};
  for (const auto& o : offsets(step)) {
    if (y + o.dy < 0 || y + o.dy >= height)
      row.paired = false;
    else
      row.taps.push_back({o.dy * pitch_for(width) + o.dx, o.dx, o.dy});
  }
  return row;
}

// Everything about one run: range, place, and adding.
std::string breaks_in_run(const Row& row, int x, int n, Exponents& stored) {
  row.weigh(x, n, true, stored.data());
  const int written = (n + 31) / 32 * 32;
  Exponents added;
  for (std::size_t t = 0; t < row.taps.size(); ++t) std::fill_n(added.data() + t * kRow, kRow, kBefore);
  row.weigh(x, n, false, added.data());
  for (int t = 0; t < QUELL_MAX_TAPS; ++t)
    for (int i = 0; i < kRow; ++i) {
      const float e = stored.data()[t * kRow + i];
      const bool touched = std::bit_cast<std::uint32_t>(e) != kUntouched;
      const bool wanted = t < int(row.taps.size()) && i < n;
      if (touched && !wanted && (t >= int(row.taps.size()) || i >= written))
        return fmt::format("exponent [{}][{}] is written, of {} taps and {} pixels", t, i, row.taps.size(), n);
      if (!wanted) continue;
      if (!touched) return fmt::format("exponent of tap {} at ({}, {}) is not written", t, x + i, row.y);
      if (!row.inside(t, x + i)) continue;
      const auto& tap = row.taps[std::size_t(t)];
      if (!(e >= 0)) return fmt::format("exponent of tap ({}, {}) at ({}, {}) is {}", tap.dx, tap.dy, x + i, row.y, e);
      const float sum = added.data()[t * kRow + i];
      // Both may round once more or less than the other, where multiply and add are contracted.
      if (e < 1e30f && !(std::fabs(sum - kBefore - e) <= 1e-5f * (e + kBefore)))
        return fmt::format("tap ({}, {}) at ({}, {}): {} is added where {} is stored", tap.dx, tap.dy, x + i, row.y,
                           sum - kBefore, e);
    }
  return "";
}

std::string breaks_in_row(const Row& row) {
  for (int x = 0; x < row.width; x += QUELL_SEGMENT) {
    const int n = std::min(QUELL_SEGMENT, row.width - x);
    Exponents whole;
    if (const auto text = breaks_in_run(row, x, n, whole); !text.empty()) return text;
    for (const int piece : {1, 17, 32})
      for (int begin = 0; begin < n; begin += piece) {
        const int m = std::min(piece, n - begin);
        Exponents part;
        if (const auto text = breaks_in_run(row, x + begin, m, part); !text.empty()) return text;
        for (int t = 0; t < int(row.taps.size()); ++t)
          for (int i = 0; i < m; ++i) {
            const float a = std::min(whole.data()[t * kRow + begin + i], kNever);
            const float b = std::min(part.data()[t * kRow + i], kNever);
            if (row.inside(t, x + begin + i) && std::bit_cast<std::uint32_t>(a) != std::bit_cast<std::uint32_t>(b))
              return fmt::format("exponent of tap {} at ({}, {}) is {:.9g} in a run of {}, {:.9g} in a run of {}", t,
                                 x + begin + i, row.y, a, n, b, m);
          }
      }
  }
  return "";
}

}  // namespace

std::string breaks_when_weighing(const Use& use) {
  const auto image = std::ranges::find_if(use.in, [](const auto& p) { return is_pixels(p.type) && !p.images.empty(); });
  if (image == use.in.end()) return "";
  const auto extent = image->images[0].shape();
  for (const int step : {1, 4})
    for (int y = 0; y < extent.height; ++y) {
      Use poisoned = use.copy();
      const quell_reach taps{extent.width, extent.width, 2 * step, 2 * step, 0, 0};
      poison(poisoned, {0, y, extent.width, y + 1}, extent, taps);
      const Bound bound(poisoned);
      const auto row = row_of(bound, extent.width, extent.height, y, step);
      if (row.taps.empty()) continue;
      if (const auto text = breaks_in_row(row); !text.empty()) return fmt::format("step {}: {}", step, text);
    }
  return "";
}

}  // namespace quell::test
