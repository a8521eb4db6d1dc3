// Parts of options that several subcommands share.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace quell {

// Accepts these words only; a message says what there is and what was probably meant.
CLI::Validator one_of(std::vector<std::string> words);

// What a variable of a script gives that nobody set: no name of a file, and a folder that nobody meant.
CLI::Validator not_empty();

// --resume and --restart of a folder that holds the work of an earlier run: one or the other.
void add_resume(CLI::App&, bool& resume, const std::string& what_resume_does, bool& restart);

// Lets an option be given more than once, with one value each time: what follows that value is no longer the option's.
CLI::Option* repeatable(CLI::Option*);

// --size: of frames, pixels.
struct FrameSize {
  int width, height;
};
// From "1920x1080". Throws Error(Exit::usage).
FrameSize frame_size(const std::string& text);

// --simd: which of the machine's instruction sets the kernels use. Highway keeps its choice in one shared library, so
// what the program pins holds in every plugin.
struct SimdOption {
  std::string wanted = "auto";
  void add_to(CLI::App&);
  // Before any plugin runs. Throws Error(Exit::resources) when the machine lacks it.
  void apply() const;
};

// The words of this process's command line.
std::vector<std::string> command_line();

// The instruction set that kernels run with now: one of the names that --simd takes.
std::string simd_in_use();

}  // namespace quell
