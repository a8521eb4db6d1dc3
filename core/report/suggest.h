// "Did you mean": the nearest of the names that were possible.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace quell {

// The candidate nearest to `name` by edit distance (transpositions count one), or "" when none is near enough.
std::string nearest(std::string_view name, std::span<const std::string> candidates);

// Of things that have names, in their order.
template <class T>
std::vector<std::string> names_of(const T& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.emplace_back(thing.name);
  return names;
}

// "it has: image, variance. Did you mean 'image'?" with `lead` in place of "it has"; "" when there are no candidates.
// At most twelve names are listed.
std::string possibilities(std::string_view lead, std::string_view name, std::span<const std::string> candidates);

}  // namespace quell
