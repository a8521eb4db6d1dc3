// Places in texts, and diagnostics written the way a compiler writes them.
#include "core/report/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

namespace quell {

int Sources::add(std::string name, std::string text) {
  sources_.push_back({std::move(name), std::move(text), {0}});
  auto& source = sources_.back();
  for (std::size_t i = source.text.find('\n'); i != std::string::npos; i = source.text.find('\n', i + 1))
    source.lines.push_back(i + 1);
  return int(sources_.size()) - 1;
}

std::string Sources::place(TextPosition position) const {
  const auto [name, line, column] = place_parts(position);
  return line == 0 ? name : fmt::format("{}:{}:{}", name, line, column);
}

Sources::Place Sources::place_parts(TextPosition position) const {
  if (position.source < 0) return {};
  const auto& source = sources_[std::size_t(position.source)];
  if (source.name.starts_with("--")) return {source.name};
  const std::size_t offset = std::min(position.offset, source.text.size());
  const auto next = std::ranges::upper_bound(source.lines, offset);
  const std::size_t start = *(next - 1);
  const auto before = std::string_view(source.text).substr(start, offset - start);
  // Bytes 10xxxxxx continue a code point; a byte order mark is no column.
  const auto column = std::ranges::count_if(before, [](char c) { return (c & 0xC0) != 0x80; }) + 1;
  const bool mark = start == 0 && before.starts_with("\xEF\xBB\xBF");
  return {source.name, std::size_t(next - source.lines.begin()), std::size_t(column - (mark ? 1 : 0))};
}

void Diagnostics::error(TextPosition position, std::string path, std::string text, std::vector<std::string> notes,
                        Exit exit) {
  list_.push_back({Severity::error, position, std::move(path), std::move(text), std::move(notes), exit});
  ++errors_;
  exit_ = std::max(exit_, exit);
}

void Diagnostics::warning(TextPosition position, std::string path, std::string text, std::vector<std::string> notes) {
  list_.push_back({Severity::warning, position, std::move(path), std::move(text), std::move(notes)});
}

namespace {

// A stranger's file may hold bytes that drive a terminal; a message shows them in place of doing what they say.
std::string printable(const std::string& text) {
  std::string out;
  for (const char c : text)
    if ((c >= 0 && c < ' ' && c != '\n') || c == 0x7F)
      out += fmt::format("\\x{:02x}", int(c));
    else
      out += c;
  return out;
}

}  // namespace

std::string Diagnostics::format(const Diagnostic& d) const {
  std::string out = sources.place(d.position);
  if (!out.empty()) out += ": ";
  out += d.severity == Severity::error ? "error: " : "warning: ";
  if (!d.path.empty()) out += d.path + ": ";
  out += d.text + '\n';
  for (const auto& note : d.notes)
    if (!note.empty()) out += "  " + note + '\n';
  return printable(out);
}

std::vector<const Diagnostic*> Diagnostics::in_order() const {
  std::vector<const Diagnostic*> sorted;
  for (const auto& d : list_) sorted.push_back(&d);
  std::ranges::stable_sort(sorted, {},
                           [](const Diagnostic* d) { return std::pair(d->position.source, d->position.offset); });
  std::unordered_set<std::string> seen;
  std::erase_if(sorted, [&](const Diagnostic* d) { return !seen.insert(format(*d)).second; });
  return sorted;
}

std::string Diagnostics::format() const {
  std::string out;
  for (const auto* d : in_order()) out += format(*d);
  return out;
}

}  // namespace quell
