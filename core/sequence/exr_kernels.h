// Numbers of OpenEXR's blocks to floats and back, in SIMD.
//
// Before ZIP deflates a block, it puts the block's even bytes in front of its odd ones (of halves: all low bytes, then
// all high ones) and replaces each byte but the first by its difference from the one before, plus 128.
#pragma once

#include <cstddef>
#include <cstdint>

namespace quell {

// Differences to bytes, in place.
void sum_differences(std::uint8_t* bytes, std::size_t n);
void take_differences(const std::uint8_t* bytes, std::uint8_t* differences, std::size_t n);

// n pairs of an even and an odd byte.
void join_bytes(const std::uint8_t* even, const std::uint8_t* odd, std::uint8_t* pairs, std::size_t n);
void split_bytes(const std::uint8_t* pairs, std::uint8_t* even, std::uint8_t* odd, std::size_t n);

// n halves, whole or with their low and high bytes apart. Exact to float; to half the nearest, ties to even, after
// what half cannot hold has been brought to ±65504.
void halves_to_floats(const std::uint8_t* halves, float* floats, std::size_t n);
void halves_to_floats(const std::uint8_t* low, const std::uint8_t* high, float* floats, std::size_t n);
void floats_to_halves(const float* floats, std::uint8_t* low, std::uint8_t* high, std::size_t n);
void floats_to_halves(const float* floats, std::uint16_t* halves, std::size_t n);

}  // namespace quell
