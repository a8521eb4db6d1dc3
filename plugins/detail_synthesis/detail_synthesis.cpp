// Puts back what the levels of a wavelet transform took away, each level's detail by its own share.
#include <quell/node.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr int kMostLevels = 8;

struct DetailSynthesis {
  quell::InList<quell::Radiance> levels;
  quell::Out<quell::Radiance> image;
  quell::Vec<kMostLevels> share{{0, 0, 0, 0, 0, 0, 0, 0}};

  void describe(quell::Describe& d) {
    d.summary("Adds shares of the details between the levels of an à-trous transform to the last level.");
    d.source(
        "Dammertz et al. 2010, Edge-Avoiding À-Trous Wavelet Transform for fast Global Illumination Filtering: c_N + Σ "
        "β_i d_i with the details d_i = c_i − c_{i+1}");
    d.in(levels, "levels", "c_0, the input of the transform, then the output of each level, c_1 … c_N; N at most 8.");
    d.out(image, "image", "c_N + Σ share_i (c_i − c_{i+1}), raised to 0 where shares that rise leave less.");
    d.param(share, "share",
            "Share of each detail, the finest first; those beyond N are not used. All 0: the last level. All 1: the "
            "first, to "
            "the bit.")
        .range(0.0f, 1.0f);
  }

  void shapes(const quell_spec& spec, quell_shape*) const {
    const int n = spec.in_count[levels.index];
    if (n < 1 || n > kMostLevels + 1)
      throw std::runtime_error("'levels' has " + std::to_string(n) + " images: name the input and 0 to 8 levels");
  }

  // Summed as Σ (share_i − share_{i−1}) c_i, where the share before the first is 0 and that of c_N is 1: with equal
  // shares no difference is taken and given back.
  void run(const quell::Tile& tile) const {
    const auto list = tile[levels];
    std::vector<float> factor(list.size());
    for (std::size_t i = 0; i < list.size(); ++i)
      factor[i] = (i + 1 < list.size() ? share.v[i] : 1) - (i ? share.v[i - 1] : 0);
    for (int c = 0; c < 3; ++c)
      for (int y = tile.y0; y < tile.y1; ++y) {
        float* out = tile.row(image, c, y);
        std::fill(out + tile.x0, out + tile.x1, 0.0f);
        for (std::size_t i = 0; i < list.size(); ++i) {
          if (factor[i] == 0) continue;
          const float* level = list[i].plane[c] + y * list[i].pitch;
          for (int x = tile.x0; x < tile.x1; ++x) out[x] += factor[i] * level[x];
        }
        for (int x = tile.x0; x < tile.x1; ++x) out[x] = std::max(out[x], 0.0f);
      }
  }
};

}  // namespace
QUELL_PLUGIN("detail_synthesis", DetailSynthesis)
