// Progress of a run on stderr.
#include "apps/quell/progress.h"

#include "apps/quell/options.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace quell {

std::string duration_text(double seconds) {
  const auto s = std::llround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s / 60 % 60);
}

void ProgressOption::add_to(CLI::App& app) {
  app.add_option("--progress", wanted,
                 "On stderr: a line that renews itself where that is a terminal (auto), a JSON object a frame, or "
                 "nothing.")
      ->check(one_of({"auto", "json", "none"}))
      ->type_name("")
      ->capture_default_str();
  app.add_flag("-q,--quiet", quiet, "Prints errors, warnings and failures only.");
}

ProgressStyle ProgressOption::style() const {
  if (quiet) return ProgressStyle::none;
  if (wanted == "json") return ProgressStyle::json;
  return wanted == "none" ? ProgressStyle::none : ProgressStyle::automatic;
}

ProgressPrinter::ProgressPrinter(ProgressStyle style) : style_(style) {
  if (style_ == ProgressStyle::automatic) style_ = isatty(2) ? ProgressStyle::terminal : ProgressStyle::none;
}

ProgressPrinter::~ProgressPrinter() {
  if (open_) std::fputc('\n', stderr);
}

void ProgressPrinter::operator()(const Progress& p) {
  if (style_ == ProgressStyle::none) return;
  const auto now = std::chrono::steady_clock::now();
  const double elapsed = std::max(1e-9, std::chrono::duration<double>(now - begin_).count());
  const double rate = double(p.done) / elapsed, left = double(p.total - p.done) / rate;
  if (style_ == ProgressStyle::json) {
    fmt::print(
        stderr,
        "{{\"frame\": {}, \"done\": {}, \"total\": {}, \"frames_per_second\": {:.3f}, \"seconds_left\": {:.1f}}}\n",
        p.frame, p.done, p.total, rate, left);
    return;
  }
  if (p.done < p.total && now - shown_ < std::chrono::milliseconds(100)) return;
  shown_ = now;
  // ESC [K clears what a longer line before may have left.
  fmt::print(stderr, "\rframe {} ({}/{})  {:.2f} frames/s  {} left\033[K", p.frame, p.done, p.total, rate,
             duration_text(left));
  std::fflush(stderr);
  open_ = true;
}

}  // namespace quell
