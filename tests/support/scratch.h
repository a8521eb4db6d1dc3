// A folder of a test's own, removed when it ends.
#pragma once

#include <stdlib.h>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace quell::test {

class Scratch {
 public:
  Scratch() : folder_((std::filesystem::temp_directory_path() / "quell-test-XXXXXX").string()) {
    if (!mkdtemp(folder_.data())) throw std::runtime_error("cannot make " + folder_);
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const std::string& folder() const { return folder_; }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }

 private:
  std::string folder_;
};

}  // namespace quell::test
