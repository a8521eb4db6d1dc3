// Tests of the quell command: a folder of their own, the program run in it, and its files.
#pragma once

#include "tests/support/run_program.h"
#include "tests/support/scratch.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace quell::test {

// All channels of an image file, by name.
struct Pixels {
  int width = 0, height = 0;
  bool half = false;
  std::map<std::string, std::vector<float>> channels;
  bool operator==(const Pixels&) const = default;
};
Pixels read_pixels(const std::string& path);  // throws Error when the file is not whole

class QuellCommand : public testing::Test {
 protected:
  // Runs `quell args…` in the folder.
  ProgramResult quell(std::vector<std::string> args, ProgramOptions options = {});
  // Runs a graph over four small frames of the built-in room, `args` behind.
  ProgramResult run_room(const std::string& graph, std::vector<std::string> args, ProgramOptions options = {});
  // What starts `quell args…`, for a Program.
  static std::vector<std::string> command(const std::vector<std::string>& args);
  ProgramOptions here(ProgramOptions options = {}) const;

  std::string path(const std::string& name) const { return scratch_.path(name); }
  std::string write(const std::string& name, const std::string& text);
  std::string read(const std::string& name) const;
  // A radiance image of one value.
  void write_color(const std::string& name, int width, int height, float value);
  Pixels pixels(const std::string& name) const { return read_pixels(path(name)); }
  // Names of all files in the folder, temporary ones too, in order.
  std::vector<std::string> files(const std::string& folder = "") const;

 private:
  Scratch scratch_;
};

// Options that make the room small: 64 x 36 pixels, frames 0 to 3.
inline const std::vector<std::string> kSmallRoom = {"room",      "--source", "width=64", "--source",
                                                    "height=36", "--frames", "0-3"};

// `a` and `b` behind each other.
std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b);

}  // namespace quell::test
