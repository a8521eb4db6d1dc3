// How a wire names what it reads: "input", "node", "node.port", "level0.atrous.image", each with "@-k" for k frames
// earlier.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace quell {

inline constexpr int kMaxDelay = 64;  // each frame of delay keeps a whole image

struct Reference {
  std::vector<std::string> parts;
  int delay = 0;
};

// What is wrong with a reference; no text when nothing is.
struct ReferenceProblem {
  std::string text, note;
};

// Fills `out`, or says what is wrong.
ReferenceProblem parse_reference(std::string_view text, Reference& out);

// [a-z][a-z0-9_]*: what nodes, inputs, outputs and parameters may be called.
bool is_identifier(std::string_view);
// "a.b.c" in parts; empty when one of them is no identifier.
std::vector<std::string> split_path(std::string_view);
std::string join_path(const std::vector<std::string>&);

}  // namespace quell
