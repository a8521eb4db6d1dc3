// Outputs in which every float, margins included, starts as a pattern that no node writes.
#pragma once

#include "tests/contract/use.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace quell::test {

// A quiet NaN with a payload of its own.
inline constexpr std::uint32_t kUntouched = 0x7FC0DEADu;

class Guarded {
 public:
  explicit Guarded(const quell_shape&);
  const quell_shape& shape() const { return shape_; }
  quell_image view() const;
  std::uint32_t bits(int channel, int x, int y) const;
  float at(int channel, int x, int y) const;
  // Puts the pattern back everywhere.
  void reset();
  // The first float that `tile` of an image should have written and did not, or that it should not have written and
  // did;
  // "" when all is right. `whole`: the tile writes all of it (a table or a value).
  std::string misplaced(const Rect& tile, bool whole) const;

 private:
  quell_shape shape_;
  std::ptrdiff_t pitch_;
  std::vector<std::uint32_t> memory_;
  std::vector<float*> planes_;
};

// One a output port of a use.
struct Outputs {
  explicit Outputs(const Use&, const Bound&);
  std::vector<std::unique_ptr<Guarded>> images;  // null: the output does not exist
  std::vector<bool> pixels;                      // tiles divide it
  std::vector<int> types;
  std::vector<std::string> names;
  std::vector<quell_image> views() const;
  void reset();
};

// The first pixel within `where` that differs in any bit, as text; "" when none does. Tables and values are
// compared whole when `where` holds (0, 0).
std::string difference(const Outputs& a, const Outputs& b, const Rect& where);
// The first number in the outputs that is not finite, as text; "" when there is none.
std::string not_finite(const Outputs&);

}  // namespace quell::test
