// What packing spares: two signals packed, filtered by one à-trous level under SVGF's guides and unpacked, against two
// filters.
//
// 1080p on one thread with denormals flushed, interleaved band by band in one process; the minimum of each band over
// the rounds counts, in thread CPU time, so that other work on the machine disturbs little.
#include "tests/support/run_node.h"

#include <immintrin.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

namespace {

using quell::Image;
using quell::test::Node;

constexpr int kWidth = 1920, kHeight = 1080, kBand = 270;

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

// A node that runs on bands, with its outputs kept.
class Banded {
 public:
  Banded(const char* type, const std::vector<std::pair<const char*, int>>& ints, Image& out)
      : type_(quell::test::registry().find(type)), instance_(*type_), out_(out.view()) {
    for (const auto& [name, value] : ints) instance_.set_int(type_->find_param(name), value);
    inputs_.resize(type_->inputs().size());
  }
  Banded& in(const char* port, std::vector<quell_image>& images) {
    inputs_[std::size_t(type_->find_input(port))] = {images.data(), nullptr, int(images.size())};
    return *this;
  }
  Banded& weights(std::vector<quell_bound_weight>& weights) {
    inputs_[std::size_t(type_->find_input("weights"))] = {nullptr, weights.data(), int(weights.size())};
    return *this;
  }
  void run(int y0, int y1) const {
    const quell_image out[2] = {out_, {}};
    const quell_tile tile{inputs_.data(), out, 0, y0, kWidth, y1, 0};
    quell_error error{};
    if (type_->table().run(instance_.data(), nullptr, &tile, &error)) std::fprintf(stderr, "%s\n", error.text);
  }

 private:
  const quell::NodeType* type_;
  quell::Instance instance_;
  quell_image out_;
  std::vector<quell_input> inputs_;
};

template <class Work>
void best(double& seconds, Work work) {
  const double start = cpu_seconds();
  work();
  seconds = std::min(seconds, cpu_seconds() - start);
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 7;
  _mm_setcsr(_mm_getcsr() | 0x8040);  // flush to zero, denormals are zero, as on the host's threads
  const auto a = quell::test::noise_image(kWidth, kHeight, 3, 1), b = quell::test::noise_image(kWidth, kHeight, 3, 2);
  const auto normal = quell::test::normal_image(kWidth, kHeight, 3),
             depth = quell::test::noise_image(kWidth, kHeight, 1, 4, 5.0f, 5.1f),
             slope = quell::test::noise_image(kWidth, kHeight, 2, 5, 0.0f, 0.1f);
  Node by_normal("normal_weight"), by_depth("depth_weight");
  by_normal.in("normal", normal), by_depth.in("depth", depth).in("slope", slope);
  Image alone_a(kWidth, kHeight, 3), alone_b(kWidth, kHeight, 3), joined(kWidth, kHeight, 6),
      filtered(kWidth, kHeight, 6), out_a(kWidth, kHeight, 3), out_b(kWidth, kHeight, 3);
  std::vector<quell_image> in_a{a.view()}, in_b{b.view()}, both{a.view(), b.view()}, in_joined{joined.view()},
      in_filtered{filtered.view()};
  for (const int guides : {1, 2}) {
    std::vector<quell_bound_weight> weights{by_normal.bound(), by_depth.bound()};
    weights.resize(std::size_t(guides));
    double sums[3] = {};
    for (const int step : {1, 2, 4, 8, 16}) {
      Banded first("atrous", {{"step", step}}, alone_a), second("atrous", {{"step", step}}, alone_b),
          one("atrous", {{"step", step}}, filtered);
      first.in("image", in_a).weights(weights), second.in("image", in_b).weights(weights);
      one.in("image", in_joined).weights(weights);
      Banded pack("pack", {}, joined), unpack_a("unpack", {}, out_a), unpack_b("unpack", {{"first", 3}}, out_b);
      pack.in("images", both);
      unpack_a.in("image", in_filtered).in("like", in_a), unpack_b.in("image", in_filtered).in("like", in_b);
      pack.run(0, kHeight);
      double spent[3] = {};  // two filters, the packed one, packing and unpacking
      for (int y = 0; y < kHeight; y += kBand) {
        double least[3] = {1e9, 1e9, 1e9};
        for (int i = 0; i < rounds; ++i) {
          best(least[0], [&] { first.run(y, y + kBand), second.run(y, y + kBand); });
          best(least[1], [&] { one.run(y, y + kBand); });
          best(least[2], [&] { pack.run(y, y + kBand), unpack_a.run(y, y + kBand), unpack_b.run(y, y + kBand); });
        }
        for (int i = 0; i < 3; ++i) spent[i] += least[i];
      }
      const bool same = quell::test::same_bits(alone_a, out_a) && quell::test::same_bits(alone_b, out_b);
      std::printf("%d weights, step %2d: two filters %6.1f ms, packed %6.1f ms + %4.1f ms packing, ratio %.3f; %s\n",
                  guides, step, spent[0] * 1e3, spent[1] * 1e3, spent[2] * 1e3, (spent[1] + spent[2]) / spent[0],
                  same ? "same bits" : "bits differ");
      for (int i = 0; i < 3; ++i) sums[i] += spent[i];
    }
    std::printf("%d weights, five levels packed once: ratio %.3f\n", guides, (sums[1] + sums[2] / 5) / sums[0]);
  }
}
