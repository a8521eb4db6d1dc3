// Nodes of one row or of one pixel, which tell what they were given.
#include "tests/support/accumulator.h"

#include "tests/support/add_type.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace quell::test {

namespace {

// out = now + before, and before's missing flag in the second output.
struct Sum {
  In<Scalar> now, before;
  Out<Scalar> sum;
  Out<Count> missing;
  void describe(Describe& d) {
    d.summary("Adds.");
    d.in(now, "now", "A.");
    d.in(before, "before", "B.").optional();
    d.out(sum, "sum", "A + B.").passes(now);
    d.out(missing, "missing", "1 where B has no past.");
  }
  void run(const Tile& t) const {
    for (int y = t.y0; y < t.y1; ++y)
      for (int x = t.x0; x < t.x1; ++x) {
        t.row(sum, 0, y)[x] = t.row(now, 0, y)[x] + (t.has(before) ? t.row(before, 0, y)[x] : 0);
        t.row(missing, 0, y)[x] = t.missing(before) ? 1.0f : 0.0f;
      }
  }
};

// Mean of rows up to `radius` above and below, read `step` apart.
struct Blur {
  In<Scalar> image;
  Out<Scalar> blurred;
  int radius = 2, step = 1;
  void describe(Describe& d) {
    d.summary("Blurs.");
    d.in(image, "image", "A.").halo(0, radius * step).step(step);
    d.out(blurred, "image", "Blurred.").passes(image);
    d.param(radius, "radius", "Rows.").range(0, 16);
    d.param(step, "step", "Rows apart.").range(1, 64);
  }
  void run(const Tile& t) const {
    const int h = t[image].height;
    for (int y = t.y0; y < t.y1; ++y)
      for (int x = t.x0; x < t.x1; ++x) {
        float sum = 0, n = 0;
        for (int k = -radius; k <= radius; ++k)
          if (const int v = y + k * step; v >= 0 && v < h)
            sum += t.row(image, 0, v)[x] * float(k + 20), n += float(k + 20);
        t.row(blurred, 0, y)[x] = sum / n;
      }
  }
};

struct Fails {
  In<Scalar> image;
  Out<Scalar> out;
  int at_row = 5;
  void describe(Describe& d) {
    d.summary("Fails.");
    d.in(image, "image", "A.");
    d.out(out, "image", "B.");
    d.param(at_row, "at_row", "Row.");
  }
  void run(const Tile& t) const {
    if (t.frame >= 3 && t.y0 <= at_row && at_row < t.y1)
      throw std::runtime_error("row " + std::to_string(at_row) + " is unlucky");
    for (int y = t.y0; y < t.y1; ++y) std::fill_n(t.row(out, 0, y) + t.x0, t.x1 - t.x0, 1.0f);
  }
};

Registry& nodes() {
  static Registry registry({});
  static const bool added =
      add_type<Sum>(registry, "sum") && add_type<Blur>(registry, "blur") && add_type<Fails>(registry, "fails");
  EXPECT_TRUE(added);
  return registry;
}

}  // namespace

GraphNode make(const char* name, const char* type, std::vector<std::vector<Wire>> in) {
  const auto* t = nodes().find(type);
  std::vector<int> types;
  for (const auto& o : t->outputs()) types.push_back(o.type);
  return {name, Instance(*t), std::move(in), types, {}};
}

Graph accumulator() {
  Graph g;
  g.name = "accumulator";
  g.inputs = {{"a", QUELL_SCALAR, false}};
  g.nodes.push_back(make("total", "sum", {{{input(), 0, {}}}, {{{0, 0}, 1, {}}}}));
  g.outputs = {{"total", {{0, 0}, 0, {}}, QUELL_SCALAR, false}, {"missing", {{0, 1}, 0, {}}, QUELL_COUNT, false}};
  return g;
}

bool same(const Image& a, const Image& b) {
  if (a.width() != b.width() || a.height() != b.height() || a.channels() != b.channels()) return false;
  for (int c = 0; c < a.channels(); ++c)
    for (int y = 0; y < a.height(); ++y)
      if (std::memcmp(a.row(c, y), b.row(c, y), std::size_t(a.width()) * 4)) return false;
  return true;
}

}  // namespace quell::test
