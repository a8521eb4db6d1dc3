// A variant: a graph laid over its base, and the same edits from the command line.
#pragma once

#include "core/graph/document.h"

#include <span>
#include <string>
#include <vector>

namespace quell {

// An option of the command line, as given behind its name: set "level0.atrous.step=2", swap "by_normal=plane_weight",
// wire "history.image=level1.image@-1", bypass "clamp", tap "blend.image".
struct Edit {
  enum class Kind { set, swap, wire, bypass, tap };
  Kind kind;
  std::string text;
};

// A buffer that is to be written too.
struct Tap {
  std::string name;
  WireSpec wire;
};

struct Edits {
  std::vector<Change> changes;
  std::vector<Tap> taps;
};

// Reads options. Each becomes a source of its own, called `--set #2` by its kind and number.
Edits parse_edits(std::span<const Edit>, Faults&);

// The short forms "set", "swap", "wire" and "bypass" of a variant, in the order in which they are applied.
std::vector<Change> parse_changes(const Json& variant, Faults&);

// Removes those changes of a base that `over` writes as keys: the params, set, in, type and bypass that it gives, and
// all that is addressed to a node that it removes. Short forms are applied after all keys, so they would win over them.
void drop_overridden(std::vector<Change>&, const Json& over);

// `variant` over `base`: same keys; null removes. Ignores short forms and "base".
Json overlay(Json base, const Json& variant, Faults&);

}  // namespace quell
