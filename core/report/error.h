// Failures that end a command, with the exit code that they cause.
#pragma once

#include <stdexcept>
#include <string>

namespace quell {

enum class Exit { good = 0, threshold = 1, usage = 2, input = 3, plugin = 4, resources = 5, interrupted = 130 };

class Error : public std::runtime_error {
 public:
  Error(Exit exit, const std::string& text) : std::runtime_error(text), exit_(exit) {}
  Exit exit() const { return exit_; }

 private:
  Exit exit_;
};

}  // namespace quell
