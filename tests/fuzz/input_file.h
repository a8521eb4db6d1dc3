// The bytes of an input as a file, for what reads files.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace quell::fuzz {

// In a folder of this process that holds nothing else, so that patterns find no files. The next input takes its place.
inline std::string input_file(const std::uint8_t* data, std::size_t size) {
  static const auto file = [] {
    const auto folder = std::filesystem::temp_directory_path() / ("quell-fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    return (folder / "input.json").string();
  }();
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), std::streamsize(size));
  return file;
}

}  // namespace quell::fuzz
