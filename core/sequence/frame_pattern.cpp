// Expansion of frame patterns, and the search for the files that they name.
#include "core/sequence/frame_pattern.h"

#include "core/report/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <filesystem>

namespace quell {

namespace {

// Characters of a placeholder at `at`, and the digits that it stands for; 0 when there is none.
std::size_t placeholder(const std::string& text, std::size_t at, int& digits) {
  constexpr int kMostDigits = 32;
  if (text[at] == '%') {
    std::size_t end = at + 1;
    int width = 0;
    for (; end < text.size() && text[end] >= '0' && text[end] <= '9' && width <= kMostDigits; ++end)
      width = width * 10 + (text[end] - '0');
    // "%4d" pads with spaces, which no renderer does.
    const bool padded = end == at + 1 || text[at + 1] == '0';
    if (end == text.size() || text[end] != 'd' || !padded || width > kMostDigits) return 0;
    digits = std::max(width, 1);
    return end + 1 - at;
  }
  std::size_t end = at;
  int hashes = 0;
  for (; end < text.size() && (text[end] == '#' || text[end] == '@') && end - at < kMostDigits; ++end)
    hashes += text[end] == '#';
  digits = int(end - at) + (hashes == 1 ? 3 : 0);
  return end - at;
}

}  // namespace

FramePattern::FramePattern(std::string text) : text_(std::move(text)) {
  const std::size_t slash = text_.rfind('/');
  const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
  const auto split = [&](std::size_t from) {
    parts_ = {text_.substr(0, from)};
    digits_.clear();
    for (std::size_t at = from; at < text_.size();) {
      int digits = 0;
      const std::size_t length = placeholder(text_, at, digits);
      if (length == 0) {
        parts_.back() += text_[at++];
        continue;
      }
      digits_.push_back(digits);
      parts_.emplace_back();
      at += length;
    }
  };
  split(name);
  if (!numbered()) split(0);
}

std::string FramePattern::path(std::int64_t frame) const {
  std::string out = parts_.empty() ? "" : parts_[0];
  for (std::size_t i = 0; i < digits_.size(); ++i) {
    // As printf has it, a sign is one of the characters.
    out += fmt::format("{:0{}}", frame, digits_[i]);
    out += parts_[i + 1];
  }
  return out;
}

std::vector<std::int64_t> FramePattern::scan() const {
  const std::filesystem::path path = text_;
  const std::string name = path.filename().string();
  const FramePattern local(name);
  if (!local.numbered()) {
    throw Error(Exit::usage,
                fmt::format("'{}' has no frame number in its file name, so frames cannot be found by looking; "
                            "say which there are",
                            text_));
  }
  const std::filesystem::path folder = path.parent_path().empty() ? "." : path.parent_path();
  std::error_code error;
  std::vector<std::int64_t> frames;
  auto entry = std::filesystem::directory_iterator(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const std::string file = entry->path().filename().string();
    if (!file.starts_with(local.parts_[0])) continue;
    std::int64_t frame = 0;
    const char* begin = file.data() + local.parts_[0].size();
    const auto [end, bad] = std::from_chars(begin, file.data() + file.size(), frame);
    // What comes back from the number must be the very name: so "01" is no frame of "@".
    if (bad == std::errc() && local.path(frame) == file) frames.push_back(frame);
  }
  if (error)
    throw Error(Exit::input, fmt::format("cannot look for '{}': {}: {}", text_, folder.string(), error.message()));
  std::ranges::sort(frames);
  return frames;
}

}  // namespace quell
