// Words to choose from, sizes, and the choice of SIMD target.
#include "apps/quell/options.h"

#include "core/report/error.h"
#include "core/report/suggest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>

namespace quell {

namespace {

struct Target {
  const char* name;
  std::int64_t bit;
};

// Those that <quell/simd.h> compiles kernels for, best first.
constexpr Target kTargets[] = {{"avx512", HWY_AVX3}, {"avx2", HWY_AVX2}, {"sse4", HWY_SSE4}, {"scalar", HWY_SCALAR}};

// Scalar code is always there, but Highway does not always list it.
bool present(const Target& target) { return target.bit == HWY_SCALAR || (hwy::SupportedTargets() & target.bit); }

}  // namespace

CLI::Validator one_of(std::vector<std::string> words) {
  const auto description = fmt::format("{}", fmt::join(words, "|"));
  return CLI::Validator(
      [words = std::move(words)](const std::string& word) {
        if (std::ranges::find(words, word) != words.end()) return std::string();
        return fmt::format("'{}' is not possible\n  {}", word, possibilities("it takes", word, words));
      },
      description, "one_of");
}

CLI::Validator not_empty() {
  return CLI::Validator([](const std::string& text) { return std::string(text.empty() ? "is empty" : ""); }, "",
                        "not_empty");
}

void add_resume(CLI::App& app, bool& resume, const std::string& what_resume_does, bool& restart) {
  auto* option = app.add_flag("--resume", resume, what_resume_does);
  app.add_flag("--restart", restart, "Begins anew in a folder that holds the work of an earlier run.")
      ->excludes(option);
}

CLI::Option* repeatable(CLI::Option* option) {
  return option->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)->allow_extra_args(false);
}

FrameSize frame_size(const std::string& text) {
  constexpr int kMost = 65536;
  FrameSize size{};
  char end = 0;
  const int read = std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &end);
  if (read != 2 || std::min(size.width, size.height) < 1 || std::max(size.width, size.height) > kMost)
    throw Error(Exit::usage, fmt::format("--size {}: expected WIDTHxHEIGHT in pixels, as in 1920x1080", text));
  return size;
}

void SimdOption::add_to(CLI::App& app) {
  app.add_option("--simd", wanted,
                 "Instruction set of the kernels. Each gives the same bits on every machine that has it.")
      ->check(one_of({"auto", "scalar", "sse4", "avx2", "avx512"}))
      ->type_name("")
      ->capture_default_str()
      ->group("Tuning");
}

void SimdOption::apply() const {
  if (wanted == "auto") return;
  std::vector<std::string> here;
  for (const auto& target : kTargets) {
    if (!present(target)) continue;
    here.emplace_back(target.name);
    if (wanted != target.name) continue;
    hwy::DisableTargets(~target.bit);
    return;
  }
  throw Error(Exit::resources,
              fmt::format("--simd {}: this machine lacks it; it has: {}", wanted, fmt::join(here, ", ")));
}

std::vector<std::string> command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(std::move(word));
  return words;
}

std::string simd_in_use() {
  const auto best = std::ranges::find_if(kTargets, present);
  // Asking Highway for the targets makes it choose among all of them, whatever has been disabled; the next kernel is to
  // choose anew.
  hwy::GetChosenTarget().DeInit();
  return best == std::end(kTargets) ? "scalar" : best->name;
}

}  // namespace quell
