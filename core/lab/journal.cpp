// Entries as JSON. What cannot be read is taken for absent: it is computed again.
#include "core/lab/journal.h"

#include "core/sequence/temporary_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>
#include <system_error>

namespace quell {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

json to_json(const JournalEntry& e) {
  json numbers = json::array();
  for (const auto& frame : e.numbers) {
    auto& row = numbers.emplace_back(json::array());
    for (const auto& number : frame) row.push_back(number ? json(*number) : json());
  }
  return {{"variant", e.variant},
          {"key", e.key},
          {"numbers", std::move(numbers)},
          {"own_seconds", e.own_seconds},
          {"judged_seconds", e.judged_seconds},
          {"shared_seconds", e.shared_seconds}};
}

JournalEntry to_entry(const json& j) {
  JournalEntry e;
  e.variant = j.at("variant").get<std::string>(), e.key = j.at("key").get<std::string>();
  for (const auto& row : j.at("numbers")) {
    auto& frame = e.numbers.emplace_back();
    for (const auto& number : row)
      frame.push_back(number.is_null() ? std::nullopt : std::optional(number.get<double>()));
  }
  e.own_seconds = j.at("own_seconds").get<std::vector<double>>();
  e.judged_seconds = j.at("judged_seconds").get<double>();
  e.shared_seconds = j.at("shared_seconds").get<double>();
  return e;
}

// Null when there is no such file, or none that can be read.
json read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return {};
  auto j = json::parse(std::string{std::istreambuf_iterator<char>(in), {}}, nullptr, false);
  return j.is_discarded() ? json() : j;
}

void write(const fs::path& path, const json& j) { write_file(path.string(), j.dump() + "\n"); }

}  // namespace

fs::path Journal::entry_file(const std::string& variant) const { return folder_ / (variant + ".json"); }
// No variant's name begins with a dot.
fs::path Journal::part_file() const { return folder_ / ".part.json"; }
fs::path Journal::state_file(std::size_t next) const { return folder_ / fmt::format(".{}.state", next); }

std::optional<JournalEntry> Journal::finished(const std::string& variant, const std::string& key) const {
  try {
    if (const auto j = read(entry_file(variant)); !j.is_null())
      if (auto entry = to_entry(j); entry.key == key) return entry;
  } catch (const json::exception&) {
  }
  return std::nullopt;
}

std::optional<JournalPart> Journal::part() const {
  try {
    const auto j = read(part_file());
    if (j.is_null()) return std::nullopt;
    JournalPart part;
    for (const auto& entry : j.at("entries")) part.entries.push_back(to_entry(entry));
    part.state = j.at("state").get<std::string>(), part.files = j.at("files").get<std::string>();
    return part;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

void Journal::save(const JournalPart& part) const {
  json entries = json::array();
  for (const auto& entry : part.entries) entries.push_back(to_json(entry));
  write(part_file(), {{"entries", std::move(entries)}, {"state", part.state}, {"files", part.files}});
  std::error_code error;
  std::vector<fs::path> old;
  for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
    const auto file = it->path().filename().string();
    if (file.starts_with(".") && file.ends_with(".state") && file != part.state) old.push_back(it->path());
  }
  for (const auto& file : old) fs::remove(file, error);
}

void Journal::finish(const JournalPart& part) const {
  for (const auto& entry : part.entries) write(entry_file(entry.variant), to_json(entry));
  std::error_code error;
  fs::remove(part_file(), error);
  if (!part.state.empty()) fs::remove(folder_ / part.state, error);
}

}  // namespace quell
