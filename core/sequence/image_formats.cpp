// Finds the library of image formats beside the program, as the plugins are found.
#include "core/sequence/image_formats.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace quell {

namespace {

const ImageFormats* open_library() {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  const auto file = program.parent_path().parent_path() / QUELL_IMAGE_FORMATS;
  const auto fail = [&](const std::string& why) {
    throw std::runtime_error(
        fmt::format("files other than OpenEXR need the library '{}', which cannot be used: {}", file.string(), why));
  };
  // Never closed: what it made may still be in use at exit.
  void* library = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (!library) fail(dlerror());
  const auto function = reinterpret_cast<decltype(&quell_image_formats)>(dlsym(library, "quell_image_formats"));
  if (!function) fail("it exports no function quell_image_formats");
  const ImageFormats* formats = function();
  if (std::string_view(formats->version) != QUELL_VERSION)
    fail(fmt::format("it is of version {}, not " QUELL_VERSION, formats->version));
  return formats;
}

}  // namespace

const ImageFormats& image_formats() {
  static const ImageFormats* formats = open_library();
  return *formats;
}

}  // namespace quell
