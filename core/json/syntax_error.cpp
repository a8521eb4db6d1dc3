// What the library says is parsed for its context only; the place and the offending token are found in the text itself.
#include "core/json/syntax_error.h"

#include <fmt/format.h>

#include <algorithm>

namespace quell {

namespace {

bool blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// Behind blanks and whole comments; stops at a comment that does not end.
std::size_t skip_blanks(std::string_view text, std::size_t at) {
  if (at == 0 && text.starts_with("\xEF\xBB\xBF")) at = 3;
  while (at < text.size()) {
    const auto rest = text.substr(at);
    std::size_t next = at;
    if (blank(text[at])) {
      next = at + 1;
    } else if (rest.starts_with("//")) {
      next = std::min(text.find('\n', at), text.size());
    } else if (rest.starts_with("/*")) {
      const std::size_t end = text.find("*/", at + 2);
      if (end != text.npos) next = end + 2;
    }
    if (next == at) break;
    at = next;
  }
  return at;
}

std::string token_at(std::string_view text, std::size_t at) {
  if (at >= text.size()) return "the end of the file";
  std::size_t end = at + 1;
  if (text[at] == '"') {
    end = std::min(text.find_first_of("\"\n", at + 1), text.size());
    if (end < text.size() && text[end] == '"') ++end;
  } else if (std::string_view("{}[],:").find(text[at]) == std::string_view::npos) {
    while (end < text.size() && !blank(text[end]) &&
           std::string_view("{}[],:\"").find(text[end]) == std::string_view::npos)
      ++end;
  }
  if (end - at > 32) {
    end = at + 32;
    while (end > at && (text[end] & 0xC0) == 0x80) --end;
    return fmt::format("'{}…'", text.substr(at, end - at));
  }
  return fmt::format("'{}'", text.substr(at, end - at));
}

}  // namespace

SyntaxError rephrase_syntax_error(std::string_view text, std::size_t last_end, bool opened, std::string_view what) {
  const auto says = [&](std::string_view part) { return what.find(part) != what.npos; };
  SyntaxError error{skip_blanks(text, last_end), "", ""};
  const bool wants_key = says("parsing object key"),
             wants_value = says("parsing value") && !says("; expected end of input");
  // A separator between the last token and the offending one is as it should be.
  bool comma = false;
  if ((wants_key || wants_value) && !opened && last_end > 0 && error.offset < text.size() &&
      (text[error.offset] == ',' || text[error.offset] == ':')) {
    comma = text[error.offset] == ',';
    error.offset = skip_blanks(text, error.offset + 1);
  }
  const std::string found = token_at(text, error.offset);
  const bool unexpected = says("unexpected ");
  if (says("ill-formed UTF-8")) {
    error.text = "the text is not UTF-8";
  } else if (says("invalid comment")) {
    error.text = says("missing closing") ? "the comment has no closing */" : "a comment begins with // or /*";
  } else if (says("number overflow")) {
    error.text = fmt::format("the number {} is too large", found);
  } else if (says("missing closing quote")) {
    error.text = "the text has no closing quote";
  } else if (says("invalid string: control character")) {
    error.text = "the text holds a line end or control character";
    error.note = "write \\n, \\t or \\u00XX within quotes; or is the closing quote missing?";
  } else if (says("invalid string")) {
    error.text = fmt::format("bad escape in {}", found);
    error.note = "escapes are \\\" \\\\ \\/ \\b \\f \\n \\r \\t and \\uXXXX";
  } else if (says("invalid number")) {
    error.text = fmt::format("{} is no number", found);
  } else if (says("; expected end of input")) {
    error.text = fmt::format("expected the end of the file, found {}", found);
  } else if (wants_key) {
    error.text = fmt::format("expected a key in quotes, found {}", found);
    if (comma && found == "'}'") error.note = "no comma may follow the last member";
  } else if (says("parsing object separator")) {
    error.text = fmt::format("expected ':' after the key, found {}", found);
  } else if (says("parsing object")) {
    error.text = fmt::format("expected ',' or '}}', found {}", found);
  } else if (says("parsing array")) {
    error.text = fmt::format("expected ',' or ']', found {}", found);
  } else {
    error.text = fmt::format("expected a value, found {}", found);
    if (comma && found == "']'") error.note = "no comma may follow the last item";
    if (!unexpected) error.note = "text stands in double quotes; the only words are true, false and null";
  }
  return error;
}

}  // namespace quell
