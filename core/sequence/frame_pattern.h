// File names with a frame number in them: "beauty_@.exr", "render.####.exr", "out/%04d.exr".
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace quell {

// A lone `#` stands for four digits, of several each for one ("####" is four too), and `@` for one; those side by side
// add up ("#@@" is six). A number that needs more digits has them. "%04d" and "%d" say the same. Where the file's own
// name holds no number, those in its folders count, so that a folder called "shot#2" is a folder.
class FramePattern {
 public:
  FramePattern() = default;
  explicit FramePattern(std::string text);

  const std::string& text() const { return text_; }
  // False for one file that serves all frames.
  bool numbered() const { return parts_.size() > 1; }
  std::string path(std::int64_t frame) const;
  // Numbers of the files that exist, in order. Throws Error(Exit::input) when the folder cannot be read, and
  // Error(Exit::usage) when a folder's name holds the number.
  std::vector<std::int64_t> scan() const;

 private:
  std::string text_;
  std::vector<std::string> parts_;  // literal text between the numbers
  std::vector<int> digits_;         // least digits of each number; one fewer than parts_
};

}  // namespace quell
