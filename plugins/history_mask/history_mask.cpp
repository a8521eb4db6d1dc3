// Tells pixels whose past is known from those that are new.
#include <quell/node.h>

#include <cmath>

#include "disocclusion/taps.h"

namespace {

enum class Where : std::int32_t { known, fresh };

struct HistoryMask {
  quell::In<quell::Motion> motion;
  quell::In<quell::Taps> taps;
  quell::In<quell::Any> before;
  quell::Out<quell::Scalar> mask;
  Where where = Where::known;

  void describe(quell::Describe& d) {
    d.summary("Marks the pixels that can be compared with the previous frame, or those that it did not show.");
    d.in(motion, "motion", "Pixels, previous − current.");
    d.in(taps, "taps", "Weights and masks by disocclusion, of the same motion, mode bilinear.");
    d.in(before, "before",
         "A delayed wire, of any image: where it has no past, as on the first frame and after a cut, nothing is "
         "marked.")
        .optional()
        .anywhere();
    d.out(mask, "mask", "1 where marked, else 0.");
    d.param(where, "where",
            "known: each of the four previous pixels that share in the position is valid, so that a difference along "
            "motion is none between objects. new: none of them is.",
            {"known", "new"});
  }

  void run(const quell::Tile& tile) const {
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float *mx = tile.row(motion, 0, y), *my = tile.row(motion, 1, y);
      const float* weight[4];
      for (int t = 0; t < 4; ++t) weight[t] = tile.row(taps, t, y);
      const std::uint32_t* around = tile.bits(taps, quell::kTapsMask, y);
      float* out = tile.row(mask, 0, y);
      const bool none = tile.missing(before);
      for (int x = tile.x0; x < tile.x1; ++x) {
        const bool reached = weight[0][x] + weight[1][x] + weight[2][x] + weight[3][x] > 0;
        const bool marked =
            where == Where::known ? reached && whole(float(x) + mx[x], float(y) + my[x], around[x]) : !reached;
        out[x] = marked && !none ? 1.0f : 0.0f;
      }
    }
  }

 private:
  // Which columns or rows of the 3×3 the two bilinear taps of a position fall on, those without weight left out. The
  // 3×3 lies around the nearest pixel, and positions are rounded as disocclusion rounds them.
  struct Span {
    int first, last;
  };
  static Span span(float position) {
    const float between = position - std::floor(position);
    const int west = between >= 0.5f ? 0 : 1;
    return {between < 1 ? west : west + 1, between > 0 ? west + 1 : west};
  }
  static bool whole(float x, float y, std::uint32_t around) {
    const Span columns = span(x), rows = span(y);
    for (int j = rows.first; j <= rows.last; ++j)
      for (int i = columns.first; i <= columns.last; ++i)
        if (!(around >> (3 * j + i) & 1u)) return false;
    return true;
  }
};

}  // namespace
QUELL_PLUGIN("history_mask", HistoryMask)
