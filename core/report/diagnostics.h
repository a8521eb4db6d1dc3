// Errors and warnings with places, collected by a stage and reported together, as a compiler does.
#pragma once

#include "core/report/error.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace quell {

// A place in a text: a graph file, a sequence file or an option such as `--set #2`.
struct TextPosition {
  int source = -1;  // index into Sources; -1 is nowhere
  std::size_t offset = 0;
};

// The texts that positions point into.
class Sources {
 public:
  int add(std::string name, std::string text);
  const std::string& name(int source) const { return sources_[std::size_t(source)].name; }
  const std::string& text(int source) const { return sources_[std::size_t(source)].text; }
  // "graphs/svgf.json:21:34"; the name alone for an option, which starts with "--"; "" for nowhere. Lines and columns
  // count from 1; columns count UTF-8 code points.
  std::string place(TextPosition) const;
  // The same for machines: the name, or "" for nowhere; line and column are 0 for an option.
  struct Place {
    std::string name;
    std::size_t line = 0, column = 0;
  };
  Place place_parts(TextPosition) const;

 private:
  struct Source {
    std::string name, text;
    std::vector<std::size_t> lines;  // where each starts
  };
  std::vector<Source> sources_;
};

enum class Severity { error, warning };

struct Diagnostic {
  Severity severity;
  TextPosition position;
  std::string path;                // where in the document: "nodes.level0.in.image"; may be empty
  std::string text;                // what is wrong, with the offending value
  std::vector<std::string> notes;  // what was possible: "it has: image, variance. Did you mean 'image'?"
  Exit exit = Exit::usage;         // what kind of thing is at fault
};

class Diagnostics {
 public:
  void error(TextPosition, std::string path, std::string text, std::vector<std::string> notes = {},
             Exit exit = Exit::usage);
  void warning(TextPosition, std::string path, std::string text, std::vector<std::string> notes = {});
  bool ok() const { return errors_ == 0; }
  std::size_t errors() const { return errors_; }
  // The exit code that the errors ask for: of several kinds, the one with the highest number; good without errors.
  Exit exit() const { return exit_; }
  const std::vector<Diagnostic>& list() const { return list_; }

  Sources sources;

  // One diagnostic: "place: error: path: text" and its notes, each on a line of its own indented by two.
  std::string format(const Diagnostic&) const;
  // All, in order of place within each source, without doubles.
  std::string format() const;
  std::vector<const Diagnostic*> in_order() const;

 private:
  std::vector<Diagnostic> list_;
  std::size_t errors_ = 0;
  Exit exit_ = Exit::good;
};

}  // namespace quell
