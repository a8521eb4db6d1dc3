// The errors of one graph: a subgraph used five times says each thing once, and a hopeless file does not flood the
// screen.
#pragma once

#include "core/report/diagnostics.h"

#include <string>
#include <unordered_set>
#include <vector>

namespace quell {

class Faults {
 public:
  explicit Faults(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void error(TextPosition, std::string path, std::string text, std::vector<std::string> notes = {},
             Exit exit = Exit::usage);
  void warning(TextPosition, std::string path, std::string text, std::vector<std::string> notes = {});
  bool ok() const { return errors_ == 0; }
  bool full() const;  // nothing more will be said: no need to look for a suggestion
  Diagnostics& diagnostics() { return diagnostics_; }
  Sources& sources() { return diagnostics_.sources; }

 private:
  bool fresh(TextPosition, const std::string& text);

  Diagnostics& diagnostics_;
  std::unordered_set<std::string> seen_;
  int errors_ = 0, warnings_ = 0;
};

}  // namespace quell
