// Layered layout after Sugiyama, Tagawa and Toda 1981: ranks, waypoints where a line passes a rank, fewer crossings by
// barycentres, and then columns by isotonic regression, which is the exact least-squares answer for one rank.
#include "core/graph/drawing.h"

#include <algorithm>
#include <numeric>

namespace quell {

namespace {

constexpr int kSweeps = 12;
constexpr double kGap = 24;
constexpr std::size_t kMaxWaypoints = 50'000;  // beyond, long lines go straight

struct Vertex {
  int rank = 0;
  double width = 0;  // 0: a waypoint
  double x = 0;
  std::vector<int> up, down;
};

class Layered {
 public:
  Layered(const Boxes& boxes, const std::vector<double>& widths) : boxes_(boxes), vertices_(boxes.boxes.size()) {
    for (std::size_t i = 0; i < widths.size(); ++i) vertices_[i].width = widths[i];
    rank();
    waypoints();
    rows_.resize(std::size_t(ranks_));
    keys_.resize(vertices_.size());
    for (std::size_t v = 0; v < vertices_.size(); ++v) rows_[std::size_t(vertices_[v].rank)].push_back(int(v));
    for (int sweep = 0; sweep < kSweeps; ++sweep) cross_less(sweep % 2 == 0);
    for (auto& row : rows_) spread(row, [](const Vertex&) { return 0.0; });
    for (int sweep = 0; sweep < 2 * kSweeps; ++sweep) align(sweep % 2 == 0);
  }

  Layout layout(double row_height) const {
    Layout out;
    double left = 0, right = 0;
    for (const auto& v : vertices_)
      left = std::min(left, v.x - v.width / 2), right = std::max(right, v.x + v.width / 2);
    const auto at = [&](const Vertex& v) { return Point{v.x - left + kGap, (v.rank + 0.5) * row_height}; };
    for (std::size_t i = 0; i < boxes_.boxes.size(); ++i) out.box.push_back(at(vertices_[i]));
    for (const auto& chain : chains_) {
      auto& points = out.line.emplace_back();
      for (const int v : chain) points.push_back(at(vertices_[std::size_t(v)]));
    }
    out.width = right - left + 2 * kGap;
    out.height = ranks_ * row_height;
    return out;
  }

 private:
  static bool ranks(const Line& l) { return l.delay == 0; }

  // Boxes come in an order in which lines lead on. What only starts something (inputs, weights) moves down to it.
  void rank() {
    const auto n = boxes_.boxes.size();
    std::vector<std::vector<int>> from(n), to(n);
    for (const auto& l : boxes_.lines)
      if (ranks(l)) from[std::size_t(l.to)].push_back(l.from), to[std::size_t(l.from)].push_back(l.to);
    for (std::size_t i = 0; i < n; ++i)
      for (const int f : from[i]) vertices_[i].rank = std::max(vertices_[i].rank, vertices_[std::size_t(f)].rank + 1);
    for (std::size_t i = n; i-- > 0;) {
      const auto kind = boxes_.boxes[i].kind;
      if (to[i].empty() || (kind != Box::Kind::input && kind != Box::Kind::weight)) continue;
      int lowest = vertices_[std::size_t(to[i][0])].rank;
      for (const int t : to[i]) lowest = std::min(lowest, vertices_[std::size_t(t)].rank);
      vertices_[i].rank = lowest - 1;
    }
    for (const auto& v : vertices_) ranks_ = std::max(ranks_, v.rank + 1);
    for (std::size_t i = 0; i < n; ++i)
      if (boxes_.boxes[i].kind == Box::Kind::output) vertices_[i].rank = ranks_ - 1;
  }

  void waypoints() {
    std::size_t needed = 0;
    for (const auto& l : boxes_.lines)
      if (ranks(l)) needed += std::size_t(std::max(0, span(l) - 1));
    for (const auto& l : boxes_.lines) {
      auto& chain = chains_.emplace_back();
      if (!ranks(l)) continue;
      chain.push_back(l.from);
      for (int r = 1; needed <= kMaxWaypoints && r < span(l); ++r) {
        vertices_.push_back({vertices_[std::size_t(l.from)].rank + r, 0, 0, {}, {}});
        chain.push_back(int(vertices_.size()) - 1);
      }
      chain.push_back(l.to);
      for (std::size_t i = 1; i < chain.size(); ++i) {
        vertices_[std::size_t(chain[i - 1])].down.push_back(chain[i]);
        vertices_[std::size_t(chain[i])].up.push_back(chain[i - 1]);
      }
    }
  }
  int span(const Line& l) const { return vertices_[std::size_t(l.to)].rank - vertices_[std::size_t(l.from)].rank; }

  double mean(const std::vector<int>& of) const {
    double sum = 0;
    for (const int v : of) sum += vertices_[std::size_t(v)].x;
    return sum / double(of.size());
  }

  // Orders each row by the mean place of its neighbours in the row before.
  void cross_less(bool downwards) {
    const auto number = [&](const std::vector<int>& row) {
      for (std::size_t i = 0; i < row.size(); ++i)
        vertices_[std::size_t(row[i])].x = double(i) - double(row.size()) / 2;
    };
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      auto& row = rows_[downwards ? r : rows_.size() - 1 - r];
      number(row);
      for (const int v : row) {
        const auto& near = downwards ? vertices_[std::size_t(v)].up : vertices_[std::size_t(v)].down;
        keys_[std::size_t(v)] = near.empty() ? vertices_[std::size_t(v)].x : mean(near);
      }
      std::ranges::stable_sort(row, {}, [&](int v) { return keys_[std::size_t(v)]; });
      number(row);
    }
  }

  void align(bool downwards) {
    for (std::size_t r = 0; r < rows_.size(); ++r)
      spread(rows_[downwards ? r : rows_.size() - 1 - r], [&](const Vertex& v) {
        const auto& near = downwards ? v.up : v.down;
        return near.empty() ? v.x : mean(near);
      });
  }

  // Places a row in its order as near to what each vertex wishes as the widths allow: pool adjacent violators.
  template <class Wish>
  void spread(const std::vector<int>& row, Wish wish) {
    struct Block {
      double sum;
      int count;
      double mean() const { return sum / count; }
    };
    std::vector<double> offset(row.size(), 0.0);
    for (std::size_t i = 1; i < row.size(); ++i)
      offset[i] =
          offset[i - 1] + kGap + (vertices_[std::size_t(row[i - 1])].width + vertices_[std::size_t(row[i])].width) / 2;
    std::vector<Block> blocks;
    for (std::size_t i = 0; i < row.size(); ++i) {
      blocks.push_back({wish(vertices_[std::size_t(row[i])]) - offset[i], 1});
      while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() > blocks.back().mean()) {
        const Block last = blocks.back();
        blocks.pop_back();
        blocks.back().sum += last.sum, blocks.back().count += last.count;
      }
    }
    std::size_t i = 0;
    for (const auto& b : blocks)
      for (int k = 0; k < b.count; ++k, ++i) vertices_[std::size_t(row[i])].x = b.mean() + offset[i];
  }

  const Boxes& boxes_;
  std::vector<Vertex> vertices_;  // boxes, then waypoints
  std::vector<std::vector<int>> chains_, rows_;
  std::vector<double> keys_;
  int ranks_ = 0;
};

}  // namespace

Layout lay_out(const Boxes& boxes, const std::vector<double>& widths, double row_height) {
  return Layered(boxes, widths).layout(row_height);
}

}  // namespace quell
