// Opens real sequences for tests.
#include "tests/support/data_sequence.h"
#include "tests/support/paths.h"
#include "tests/support/read_role.h"

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace quell::test {

bool has_data() { return std::getenv("QUELL_TEST_DATA") != nullptr; }

DataSequence::DataSequence(const std::string& name, const std::string& folder, const std::string& frames) {
  const std::filesystem::path source = QUELL_TEST_SOURCE;
  SequenceRequest request;
  request.path = (source / "tests/data_sequences" / (name + ".json")).string();
  request.root = (std::filesystem::path(std::getenv("QUELL_TEST_DATA")) / folder).string();
  request.profiles = source / "graphs/profiles";
  if (!frames.empty()) request.frames = frames;
  Diagnostics diagnostics;
  const auto sequence = load_sequence(request, diagnostics);
  if (sequence) files_ = open_sequence(*sequence, {}, Missing::error, diagnostics);
  if (!files_) throw std::runtime_error(diagnostics.format());
}

Image DataSequence::read(std::int64_t frame, const std::string& role) { return read_role(*files_, frame, role); }

}  // namespace quell::test
