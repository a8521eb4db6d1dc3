// Drops what was said about the same place before, and what comes after the hundredth error.
#include "core/graph/faults.h"

#include <fmt/format.h>

namespace quell {

namespace {

constexpr int kMaxErrors = 100;

}  // namespace

bool Faults::fresh(TextPosition position, const std::string& text) {
  return seen_.insert(fmt::format("{}:{}:{}", position.source, position.offset, text)).second;
}

bool Faults::full() const { return errors_ > kMaxErrors; }

void Faults::error(TextPosition position, std::string path, std::string text, std::vector<std::string> notes,
                   Exit exit) {
  if (!fresh(position, text) || ++errors_ > kMaxErrors + 1) return;
  if (errors_ == kMaxErrors + 1) return diagnostics_.error({}, "", fmt::format("more than {} errors", kMaxErrors));
  diagnostics_.error(position, std::move(path), std::move(text), std::move(notes), exit);
}

void Faults::warning(TextPosition position, std::string path, std::string text, std::vector<std::string> notes) {
  if (!fresh(position, text) || ++warnings_ > kMaxErrors) return;
  diagnostics_.warning(position, std::move(path), std::move(text), std::move(notes));
}

}  // namespace quell
