// Frame ranges in OpenImageIO's grammar.
#include "core/sequence/frame_range.h"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <unordered_set>

namespace quell {

namespace {

constexpr std::size_t kMostFrames = 10'000'000;
constexpr std::int64_t kLargest = 1'000'000'000'000;  // so that differences and steps cannot overflow

// Takes a number off the front of `text`.
std::optional<std::int64_t> take_number(std::string_view& text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || value < -kLargest || value > kLargest) return std::nullopt;
  text.remove_prefix(std::size_t(end - text.data()));
  return value;
}

struct Span {
  std::int64_t first = 0, last = 0, step = 1;
  bool complement = false;
};

std::optional<Span> parse_span(std::string_view text) {
  Span span;
  const auto first = take_number(text);
  if (!first) return std::nullopt;
  span.first = span.last = *first;
  if (text.empty()) return span;
  if (text.front() != '-') return std::nullopt;
  text.remove_prefix(1);
  const auto last = take_number(text);
  if (!last) return std::nullopt;
  span.last = *last;
  if (text.empty()) return span;
  const char kind = text.front();
  if (kind != 'x' && kind != 'y' && kind != ':') return std::nullopt;
  text.remove_prefix(1);
  const auto step = take_number(text);
  if (!step || *step == 0 || !text.empty()) return std::nullopt;
  // A step's sign can only repeat what the ends say already.
  if (*step < 0 && span.first < span.last) return std::nullopt;
  span.step = std::abs(*step);
  span.complement = kind == 'y';
  return span;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

std::optional<std::vector<std::int64_t>> parse_frame_range(std::string_view text, std::string& problem) {
  std::vector<std::int64_t> frames;
  std::unordered_set<std::int64_t> seen;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    const std::string_view part = trimmed(text.substr(begin, comma - begin));
    begin = comma + 1;
    const auto span = parse_span(part);
    if (!span) {
      problem = fmt::format("'{}' is no frame range: write a frame, first-last or first-lastxstep, with commas between",
                            part);
      return std::nullopt;
    }
    if (span->complement && span->step == 1) continue;  // leaves out every frame
    const std::int64_t distance = std::abs(span->last - span->first), direction = span->last < span->first ? -1 : 1;
    // Counted before any is listed.
    const std::int64_t steps = distance / span->step + 1;
    if (frames.size() + std::size_t(span->complement ? distance + 1 - steps : steps) > kMostFrames) {
      problem = fmt::format("'{}' names more than {} frames", part, kMostFrames);
      return std::nullopt;
    }
    for (std::int64_t i = 0; i <= distance; i += span->complement ? 1 : span->step) {
      if (span->complement && i % span->step == 0) continue;
      const std::int64_t frame = span->first + direction * i;
      if (!seen.insert(frame).second) {
        problem = fmt::format("'{}' names frame {} twice", trimmed(text), frame);
        return std::nullopt;
      }
      frames.push_back(frame);
    }
  }
  if (frames.empty()) {
    problem = fmt::format("'{}' names no frame", trimmed(text));
    return std::nullopt;
  }
  return frames;
}

std::string frame_range_text(std::span<const std::int64_t> frames) {
  std::string out;
  for (std::size_t i = 0; i < frames.size();) {
    std::size_t end = i + 1;
    while (end < frames.size() && frames[end] == frames[end - 1] + 1) ++end;
    if (!out.empty()) out += ',';
    out += end - i > 1 ? fmt::format("{}-{}", frames[i], frames[end - 1]) : fmt::format("{}", frames[i]);
    i = end;
  }
  return out;
}

}  // namespace quell
