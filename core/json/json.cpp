// Builds positioned JSON from nlohmann's SAX events, which come over an iterator that counts what was consumed.
#include "core/json/json.h"

#include "core/json/syntax_error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <unordered_map>

namespace quell {

namespace {

constexpr std::size_t kMaxDepth = 64;
constexpr std::size_t kMaxBytes = std::size_t(256) << 20;
constexpr std::size_t kMaxDuplicates = 64;                // a place is found by a walk along its line
constexpr std::size_t kMaxValues = std::size_t(1) << 22;  // a value takes a hundred times the memory of its text
constexpr std::size_t kShown = 48;

struct CountingIterator {
  using difference_type = std::ptrdiff_t;
  using value_type = char;
  using pointer = const char*;
  using reference = const char&;
  using iterator_category = std::input_iterator_tag;

  const char* at;
  std::size_t* count;
  reference operator*() const { return *at; }
  CountingIterator& operator++() {
    ++at;
    ++*count;
    return *this;
  }
  bool operator==(const CountingIterator& other) const { return at == other.at; }
  bool operator!=(const CountingIterator& other) const { return at != other.at; }
};

// Receives events; each comes when `consumed` stands just behind its token (behind one character more for a number).
class Builder : public nlohmann::json_sax<nlohmann::json> {
 public:
  Builder(const std::string& text, int source, Diagnostics& diagnostics)
      : text_(text), source_(source), diagnostics_(diagnostics) {}

  std::size_t consumed = 0;
  Json root;

  bool null() override {
    return value(Json::Kind::null, consumed - 4, [](Json&) {});
  }
  bool boolean(bool v) override {
    return value(Json::Kind::boolean, consumed - (v ? 4 : 5), [&](Json& j) { j.boolean = v; });
  }
  bool number_integer(std::int64_t v) override {
    return value(Json::Kind::integer, number_start(), [&](Json& j) { j.integer = v, j.number = double(v); });
  }
  bool number_unsigned(std::uint64_t v) override {
    if (v <= std::uint64_t(INT64_MAX)) return number_integer(std::int64_t(v));
    return number_float(double(v), "");
  }
  bool number_float(double v, const std::string&) override {
    return value(Json::Kind::number, number_start(), [&](Json& j) { j.number = v; });
  }
  bool string(std::string& v) override {
    return value(Json::Kind::text, string_start(), [&](Json& j) { j.text = std::move(v); });
  }
  bool binary(nlohmann::json::binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Json::Kind::object); }
  bool start_array(std::size_t) override { return open(Json::Kind::list); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(std::string& name) override {
    const TextPosition position{source_, string_start()};
    auto& scope = open_.back();
    last_end_ = consumed;
    opened_ = false;
    scope.key = name;
    const auto [first, fresh] = scope.keys.emplace(name, position.offset);
    if (!fresh) {
      diagnostics_.error(position, path(), fmt::format("duplicate key '{}'", name),
                         {fmt::format("the first is at {}", diagnostics_.sources.place({source_, first->second})),
                          ++duplicates_ == kMaxDuplicates ? "what follows is not read" : ""});
      if (duplicates_ == kMaxDuplicates) return false;
    }
    scope.json->members.push_back({std::move(name), position, {}});
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& e) override {
    const auto error = rephrase_syntax_error(text_, last_end_, opened_, e.what());
    diagnostics_.error({source_, error.offset}, "", error.text, {error.note});
    return false;
  }

 private:
  struct Scope {
    Json* json;
    std::string key;
    std::unordered_map<std::string, std::size_t> keys;
  };

  std::size_t number_start() const {
    constexpr std::string_view digits = "0123456789+-.eE";
    std::size_t at = consumed;
    if (at > 0 && digits.find(text_[at - 1]) == digits.npos) --at;
    while (at > 0 && digits.find(text_[at - 1]) != digits.npos) --at;
    return at;
  }
  std::size_t string_start() const {
    std::size_t at = consumed - 1;  // the closing quote
    for (std::size_t escapes = 1; escapes % 2 == 1;) {
      at = text_.rfind('"', at - 1);
      for (escapes = 0; escapes < at && text_[at - 1 - escapes] == '\\'; ++escapes) {
      }
    }
    return at;
  }

  // Where the next value goes. Members and items of open scopes do not move: only the innermost scope grows.
  Json& slot() {
    if (open_.empty()) return root;
    auto& parent = *open_.back().json;
    return parent.is(Json::Kind::object) ? parent.members.back().value : parent.items.emplace_back();
  }
  template <class Fill>
  bool value(Json::Kind kind, std::size_t offset, Fill fill) {
    if (values_++ == kMaxValues) {
      diagnostics_.error({source_, offset}, "", fmt::format("more than {} values", kMaxValues));
      return false;
    }
    Json& json = slot();
    json.kind = kind;
    json.position = {source_, offset};
    fill(json);
    const bool number = kind == Json::Kind::integer || kind == Json::Kind::number;
    last_end_ = number ? text_.find_first_not_of("0123456789+-.eE", offset) : consumed;
    if (last_end_ == std::string::npos) last_end_ = text_.size();
    opened_ = false;
    return true;
  }
  bool open(Json::Kind kind) {
    const TextPosition position{source_, consumed - 1};
    if (open_.size() == kMaxDepth) {
      diagnostics_.error(position, "", fmt::format("nested deeper than {} levels", kMaxDepth));
      return false;
    }
    if (!value(kind, consumed - 1, [](Json&) {})) return false;
    opened_ = true;
    open_.push_back({newest(), {}, {}});
    return true;
  }
  Json* newest() {
    if (open_.empty()) return &root;
    auto& parent = *open_.back().json;
    return parent.is(Json::Kind::object) ? &parent.members.back().value : &parent.items.back();
  }
  bool close() {
    open_.pop_back();
    last_end_ = consumed;
    opened_ = false;
    return true;
  }
  std::string path() const {
    std::string out;
    for (const auto& scope : open_) {
      if (scope.json->is(Json::Kind::list)) {
        out += fmt::format("[{}]", scope.json->items.empty() ? 0 : scope.json->items.size() - 1);
      } else if (!scope.key.empty()) {
        out += (out.empty() ? "" : ".") + scope.key;
      }
    }
    return out;
  }

  const std::string& text_;
  int source_;
  Diagnostics& diagnostics_;
  std::vector<Scope> open_;
  std::size_t values_ = 0, duplicates_ = 0;
  std::size_t last_end_ = 0;  // behind the last token that became an event
  bool opened_ = false;       // and it was a bracket that opens
};

std::string shortened(const std::string& text) {
  if (text.size() <= kShown) return text;
  std::size_t end = kShown;
  while (end > 0 && (text[end] & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "…";
}

}  // namespace

const Json* Json::find(std::string_view key) const {
  for (const auto& m : members)
    if (m.key == key) return &m.value;
  return nullptr;
}

std::string Json::kind_name() const {
  switch (kind) {
    case Kind::null:
      return "null";
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      return "a whole number";
    case Kind::number:
      return "a number";
    case Kind::text:
      return "text";
    case Kind::list:
      return "a list";
    case Kind::object:
      return "an object";
  }
  return "";
}

std::string Json::shown() const {
  switch (kind) {
    case Kind::null:
      return "null";
    case Kind::boolean:
      return boolean ? "true" : "false";
    case Kind::integer:
      return fmt::format("{}", integer);
    case Kind::number:
      return fmt::format("{}", number);
    case Kind::text:
      return '"' + shortened(text) + '"';
    case Kind::list:
      return items.empty() ? "[]" : "[ … ]";
    case Kind::object:
      return members.empty() ? "{}" : "{ … }";
  }
  return "";
}

Json text_json(std::string text, TextPosition position) {
  Json json;
  json.kind = Json::Kind::text, json.position = position, json.text = std::move(text);
  return json;
}

Json list_json(std::vector<Json> items, TextPosition position) {
  Json json;
  json.kind = Json::Kind::list, json.position = position, json.items = std::move(items);
  return json;
}

Json object_json(TextPosition position) {
  Json json;
  json.kind = Json::Kind::object, json.position = position;
  return json;
}

std::optional<Json> parse_json(std::string name, std::string text, Diagnostics& diagnostics) {
  const int source = diagnostics.sources.add(std::move(name), std::move(text));
  // A copy of the reference only: sources are never removed, and none is added while this one is parsed.
  const std::string& kept = diagnostics.sources.text(source);
  const std::size_t before = diagnostics.errors();
  if (kept.size() > kMaxBytes) {
    diagnostics.error({source, 0}, "", fmt::format("larger than {} MiB", kMaxBytes >> 20));
    return std::nullopt;
  }
  Builder builder(kept, source, diagnostics);
  const CountingIterator begin{kept.data(), &builder.consumed}, end{kept.data() + kept.size(), &builder.consumed};
  const bool good = nlohmann::json::sax_parse(begin, end, &builder, nlohmann::json::input_format_t::json, true, true);
  if (!good || diagnostics.errors() != before) return std::nullopt;
  return std::move(builder.root);
}

std::optional<Json> parse_json_file(const std::string& path, Diagnostics& diagnostics, Exit unreadable) {
  std::ifstream file(path, std::ios::binary);
  std::string text;
  if (file) {
    char block[1 << 16];
    while (text.size() <= kMaxBytes && (file.read(block, sizeof block), file.gcount() > 0))
      text.append(block, std::size_t(file.gcount()));
  }
  if (file.bad() || !file.is_open()) {
    const int error = errno;
    diagnostics.error({}, "", fmt::format("cannot read '{}': {}", path, std::strerror(error)), {}, unreadable);
    return std::nullopt;
  }
  return parse_json(path, std::move(text), diagnostics);
}

}  // namespace quell
