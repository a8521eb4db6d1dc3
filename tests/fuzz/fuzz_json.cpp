// Any bytes are a document or give errors that can be shown.
#include "core/json/json.h"
#include "core/report/diagnostics.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  quell::Diagnostics diagnostics;
  const auto document =
      quell::parse_json("input.json", std::string(reinterpret_cast<const char*>(data), size), diagnostics);
  if (document.has_value() != diagnostics.ok()) std::abort();
  if (!document && diagnostics.format().empty()) std::abort();
  if (document) (void)document->shown();
  return 0;
}
