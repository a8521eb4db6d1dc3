// Any bytes are a sequence file or give errors that can be shown.
#include "core/report/diagnostics.h"
#include "core/report/error.h"
#include "core/sequence/sequence.h"

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace {

// A file of this process in a folder that holds nothing else, so that patterns find no files.
const std::filesystem::path& input_file() {
  static const auto file = [] {
    auto folder = std::filesystem::temp_directory_path() / ("quell-fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    return folder / "input.json";
  }();
  return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::ofstream(input_file(), std::ios::binary).write(reinterpret_cast<const char*>(data), std::streamsize(size));
  quell::SequenceRequest request;
  request.path = input_file().string();
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
