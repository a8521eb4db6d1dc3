// Any bytes are a sequence file or give errors that can be shown.
#include "tests/fuzz/input_file.h"

#include "core/report/diagnostics.h"
#include "core/report/error.h"
#include "core/sequence/sequence.h"

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  quell::SequenceRequest request;
  request.path = quell::fuzz::input_file(data, size);
  request.profiles = QUELL_FUZZ_GRAPHS "/profiles";
  quell::Diagnostics diagnostics;
  try {
    const auto sequence = quell::load_sequence(request, diagnostics);
    if (sequence.has_value() != diagnostics.ok()) std::abort();
    if (!sequence && diagnostics.format().empty()) std::abort();
    if (sequence && sequence->frames.empty()) std::abort();
    if (sequence) (void)sequence->roles();
  } catch (const quell::Error& e) {
    if (std::string_view(e.what()).empty()) std::abort();
  }
  return 0;
}
