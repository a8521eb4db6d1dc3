// Frames of the real sequences of tests/data_sequences, where QUELL_TEST_DATA names the folder that holds their files.
#pragma once

#include "core/image/image.h"
#include "core/sequence/sequence.h"

#include <cstdint>
#include <memory>
#include <string>

namespace quell::test {

// Whether there is any: if not, a test that needs it skips.
bool has_data();

class DataSequence {
 public:
  // tests/data_sequences/<name>.json over the files of the data's folder; `frames` in place of its own, unless empty.
  // Throws where it cannot be opened.
  DataSequence(const std::string& name, const std::string& folder, const std::string& frames = "");

  FileSequence& files() { return *files_; }

  Image read(std::int64_t frame, const std::string& role);

 private:
  std::unique_ptr<FileSequence> files_;
};

}  // namespace quell::test
