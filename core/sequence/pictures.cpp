// Makes a sequence of a pattern of pictures.
#include "core/sequence/pictures.h"

#include "core/report/error.h"
#include "core/sequence/frame_range.h"

#include <fmt/format.h>

#include <filesystem>

namespace quell {

Sequence pictures(const std::string& pattern, const std::optional<std::string>& range) {
  Sequence sequence;
  sequence.path = pattern;
  SequenceInput input;
  input.role = "color";
  input.type = QUELL_RADIANCE;
  input.file = FramePattern(pattern);
  input.choices.emplace_back();
  if (!input.file.numbered()) {
    if (std::error_code error; !std::filesystem::exists(pattern, error))
      throw Error(Exit::input, fmt::format("'{}': there is no such file", pattern));
    sequence.frames = {0};
  } else if (range) {
    std::string problem;
    auto frames = parse_frame_range(*range, problem);
    if (!frames) throw Error(Exit::usage, fmt::format("--frames {}: {}", *range, problem));
    sequence.frames = std::move(*frames);
  } else {
    sequence.frames = input.file.scan();
    if (sequence.frames.empty()) throw Error(Exit::input, fmt::format("'{}': there is no such file", pattern));
  }
  sequence.inputs.push_back(std::move(input));
  return sequence;
}

}  // namespace quell
