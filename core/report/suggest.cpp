// Edit distance and the sentences made of it.
#include "core/report/suggest.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace quell {

namespace {

constexpr std::size_t kListed = 12;
constexpr std::size_t kLongest = 64;  // longer names are no slips of the pen

char lower(char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; }

// Optimal string alignment: insertions, deletions, substitutions and swaps of neighbours cost one. Case costs nothing.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::string nearest(std::string_view name, std::span<const std::string> candidates) {
  if (name.empty() || name.size() > kLongest) return "";
  const std::size_t limit = std::max<std::size_t>(1, (name.size() + 1) / 3);
  std::size_t best = limit + 1;
  std::string found;
  for (const auto& candidate : candidates) {
    if (candidate.size() > name.size() + limit || candidate.size() + limit < name.size()) continue;
    const std::size_t d = distance(name, candidate);
    if (d < best && d < candidate.size()) best = d, found = candidate;
  }
  if (!found.empty()) return found;
  // A name given in part: 'normal' for 'normal_weight', when only one begins so.
  for (const auto& candidate : candidates) {
    if (name.size() < 3 || !candidate.starts_with(name)) continue;
    if (!found.empty()) return "";
    found = candidate;
  }
  return found;
}

std::string possibilities(std::string_view lead, std::string_view name, std::span<const std::string> candidates) {
  if (candidates.empty()) return "";
  const auto listed = candidates.first(std::min(candidates.size(), kListed));
  std::string out = fmt::format("{}: {}", lead, fmt::join(listed, ", "));
  if (candidates.size() > kListed) out += fmt::format(" and {} more", candidates.size() - kListed);
  const std::string meant = nearest(name, candidates);
  return meant.empty() ? out : fmt::format("{}. Did you mean '{}'?", out, meant);
}

}  // namespace quell
