// Edits of a graph as text: for results, and as options of the command that repeats them.
#pragma once

#include "core/lab/study.h"

#include <string>

namespace quell {

// The short forms among an object's members: {"set": …, "bypass": …}.
Json edits_of(const Json& object);

// As JSON on one line: {"set":{"alpha":0.1}}.
std::string edits_text(const Json&);

// What runs a variant on the study's first sequence: "quell run svgf room --set alpha=0.1 …".
std::string run_command(const Study&, const StudyVariant&);

}  // namespace quell
