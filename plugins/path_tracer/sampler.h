// Random numbers as a pure function of (seed, frame, pixel, sample, dimension), stratified over the samples of a pixel.
//
// Each pair of dimensions is a Sobol (0,2)-sequence with its own Owen scrambling and its own shuffle of the sample
// index (Burley 2020, "Practical Hash-based Owen Scrambling", section 4 on padding), so any number of dimensions is
// good and the estimate over seeds is unbiased for any number of samples.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace path_tracer {

// A bijective hash of 32 bits without visible bias (Wellons, "Prospecting for Hash Functions", lowbias32).
inline std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}
inline std::uint32_t mixed(std::uint32_t a, std::uint32_t b) { return mixed(a ^ (mixed(b) + 0x9e3779b9u)); }

class Sampler {
 public:
  Sampler(std::uint32_t seed, std::int64_t frame, int x, int y, int sample)
      : key_(mixed(mixed(mixed(mixed(mixed(seed), std::uint32_t(frame)), std::uint32_t(std::uint64_t(frame) >> 32)),
                         std::uint32_t(x)),
                   std::uint32_t(y))),
        index_(reversed(std::uint32_t(sample))) {}

  // Two numbers in [0, 1) for dimension pair `pair`, and one.
  glm::vec2 pair(std::uint32_t pair) const {
    const std::uint32_t key = mixed(key_, pair), i = reversed(scrambled(index_, key));
    return {unit(i, mixed(key, 1)), unit(pascal(i), mixed(key, 2))};
  }
  float one(std::uint32_t pair) const {
    const std::uint32_t key = mixed(key_, pair);
    return unit(reversed(scrambled(index_, key)), mixed(key, 1));
  }

 private:
  static std::uint32_t reversed(std::uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0xff00ff00u) >> 8) | ((x & 0x00ff00ffu) << 8);
    x = ((x & 0xf0f0f0f0u) >> 4) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x & 0xccccccccu) >> 2) | ((x & 0x33333333u) << 2);
    return ((x & 0xaaaaaaaau) >> 1) | ((x & 0x55555555u) << 1);
  }
  // Owen scrambling of a bit-reversed number: each bit is flipped by a hash of the bits below it (Laine and Karras
  // 2011, with the constants of Vegdahl 2021).
  static std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
  }
  // The second Sobol dimension, bit-reversed: Pascal's triangle modulo 2, where C(k, j) is odd iff j is a subset of k.
  static std::uint32_t pascal(std::uint32_t x) {
    x ^= (x >> 1) & 0x55555555u;
    x ^= (x >> 2) & 0x33333333u;
    x ^= (x >> 4) & 0x0f0f0f0fu;
    x ^= (x >> 8) & 0x00ff00ffu;
    return x ^ ((x >> 16) & 0x0000ffffu);
  }
  // The last shift makes a lone sample as uniform as the hash is, which the scrambling alone is not.
  static float unit(std::uint32_t bits, std::uint32_t key) {
    return float(reversed(scrambled(bits, key) ^ mixed(key, 3)) >> 8) * 0x1p-24f;
  }

  std::uint32_t key_, index_;
};

}  // namespace path_tracer
