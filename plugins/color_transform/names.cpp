// Edit distance. A plugin sees none of the host's code, and so has its own.
#include "color_transform/names.h"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

namespace quell::color {

namespace {

constexpr std::size_t kListed = 12;
constexpr std::size_t kLongest = 64;

char lower(char c) { return char(std::tolower(static_cast<unsigned char>(c))); }

// Insertions, deletions and substitutions; case costs nothing.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string listed(const std::string& lead, const std::string& name, std::span<const std::string> names) {
  if (names.empty()) return lead + ": none";
  const std::string key = name.substr(0, kLongest);
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const auto& n : names) near.emplace_back(key.empty() ? 0 : distance(key, n), n);
  // A long list shows the likest, for the one that was meant is among them.
  if (names.size() > kListed) std::ranges::stable_sort(near, {}, &std::pair<std::size_t, std::string>::first);
  std::string text = lead + ": ";
  for (std::size_t i = 0; i < std::min(near.size(), kListed); ++i) text += (i ? ", " : "") + near[i].second;
  if (near.size() > kListed) text += " and " + std::to_string(near.size() - kListed) + " more";
  const auto& best = *std::ranges::min_element(near, {}, &std::pair<std::size_t, std::string>::first);
  if (!key.empty() && best.first <= std::max<std::size_t>(1, (key.size() + 1) / 3))
    text += ". Did you mean '" + best.second + "'?";
  return text;
}

}  // namespace quell::color
