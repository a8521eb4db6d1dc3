// Progress of a run on stderr: a line that renews itself on a terminal, JSON lines for machines, or nothing.
#pragma once

#include "core/run/executor.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <string>

namespace quell {

enum class ProgressStyle { automatic, terminal, json, none };

// --progress and --quiet.
struct ProgressOption {
  std::string wanted = "auto";
  bool quiet = false;
  void add_to(CLI::App&);
  ProgressStyle style() const;
};

class ProgressPrinter {
 public:
  explicit ProgressPrinter(ProgressStyle style);
  ~ProgressPrinter();
  void operator()(const Progress&);

 private:
  ProgressStyle style_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now(), shown_{};
  bool open_ = false;  // a line that does not end yet
};

// "12 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

}  // namespace quell
