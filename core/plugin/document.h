// What people read about a node type, all from its table: in a terminal, in Markdown, as JSON.
#pragma once

#include "core/plugin/node_type.h"

#include <string>
#include <string_view>

namespace quell {

// Text as it may stand in a cell of a Markdown table.
std::string markdown_cell(std::string_view);

// What a parameter takes: "a whole number from 1 to 64", "one of b3, box", "a list of 3 numbers".
std::string takes(const quell_param&);
// Its default as JSON: 0.5, "b3", [0, 1, 0].
std::string default_json(const NodeType&, int param);
// Its value as JSON, exact.
std::string value_json(const Instance&, int param);

// For `quell nodes NAME`.
std::string document_text(const NodeType&);
// A section of the node reference, headed "## name".
std::string document_markdown(const NodeType&);
// One JSON object: name, summary, source, version, weight, inputs, outputs, params.
std::string document_json(const NodeType&);

}  // namespace quell
