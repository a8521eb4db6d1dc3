// Places buffers with known lifetimes into one arena.
#pragma once

#include <cstddef>
#include <vector>

namespace quell {

// Alive from step `first` to step `last`, both included.
struct Interval {
  int first, last;
  std::size_t size;
  std::size_t offset = 0;  // filled by place()
};

// Gives each interval an offset such that no two that live at once overlap; returns the size of the arena. Largest
// first, each into the smallest gap that holds it.
std::size_t place(std::vector<Interval>&);

}  // namespace quell
