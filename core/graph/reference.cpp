// Splits names and delays.
#include "core/graph/reference.h"

#include <fmt/format.h>

#include <algorithm>

namespace quell {

bool is_identifier(std::string_view s) {
  if (s.empty() || s[0] < 'a' || s[0] > 'z') return false;
  return s.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == s.npos;
}

std::vector<std::string> split_path(std::string_view text) {
  std::vector<std::string> parts;
  for (std::size_t at = 0;;) {
    const std::size_t dot = text.find('.', at);
    const auto part = text.substr(at, dot - at);
    if (!is_identifier(part)) return {};
    parts.emplace_back(part);
    if (dot == text.npos) return parts;
    at = dot + 1;
  }
}

std::string join_path(const std::vector<std::string>& parts) { return fmt::format("{}", fmt::join(parts, ".")); }

ReferenceProblem parse_reference(std::string_view text, Reference& out) {
  const std::size_t at = text.find('@');
  out.parts = split_path(text.substr(0, at));
  out.delay = 0;
  if (out.parts.empty())
    return {fmt::format("'{}' is no wire", text),
            "a wire is input, node or node.port, with @-1 behind it for the frame before"};
  if (at == text.npos) return {};
  const auto delay = text.substr(at);
  const auto digits = delay.size() > 2 && delay[1] == '-' ? delay.substr(2) : std::string_view();
  if (digits.empty() || digits.find_first_not_of("0123456789") != digits.npos) {
    const bool future = delay.size() > 1 && (delay[1] == '+' || (delay[1] >= '0' && delay[1] <= '9'));
    return {fmt::format("bad delay '{}'", delay),
            future ? "a wire reads the past only: @-1 is the frame before" : "a delay is written @-1, @-2, …"};
  }
  const auto significant = digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
  const int frames = significant.size() > 4 ? 99999 : significant.empty() ? 0 : std::stoi(std::string(significant));
  if (frames < 1 || frames > kMaxDelay)
    return {fmt::format("bad delay '{}'", delay), fmt::format("a delay is 1 to {} frames", kMaxDelay)};
  out.delay = frames;
  return {};
}

}  // namespace quell
