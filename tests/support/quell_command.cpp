// The quell command in a folder of its own.
#include "tests/support/quell_command.h"
#include "tests/support/paths.h"

#include "core/image/image.h"
#include "core/sequence/image_file.h"
#include "core/sequence/image_writer.h"

#include <quell/types.h>

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace quell::test {

namespace fs = std::filesystem;

Pixels read_pixels(const std::string& path) {
  ImageFile file(path);
  Pixels out;
  std::vector<ChannelRead> reads;
  for (const auto& name : file.channel_names()) {
    const auto size = file.size(file.find(name));
    out.width = size.width, out.height = size.height;
    auto& plane = out.channels[name];
    plane.assign(std::size_t(size.width) * std::size_t(size.height), 0.0f);
    reads.push_back({file.find(name), plane.data()});
  }
  file.read(reads, out.width);
  if (const auto input = OIIO::ImageInput::open(path)) out.half = input->spec().format == OIIO::TypeDesc::HALF;
  return out;
}

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<std::string> QuellCommand::command(const std::vector<std::string>& args) {
  return std::vector<std::string>{QUELL_TEST_PROGRAM} + args;
}

ProgramOptions QuellCommand::here(ProgramOptions options) const {
  if (options.folder.empty()) options.folder = scratch_.folder();
  return options;
}

ProgramResult QuellCommand::quell(std::vector<std::string> args, ProgramOptions options) {
  return run_program(command(args), here(std::move(options)));
}

ProgramResult QuellCommand::run_room(const std::string& graph, std::vector<std::string> args, ProgramOptions options) {
  return quell(std::vector<std::string>{"run", graph} + kSmallRoom + args, std::move(options));
}

std::string QuellCommand::write(const std::string& name, const std::string& text) {
  fs::create_directories(fs::path(path(name)).parent_path());
  std::ofstream(path(name), std::ios::binary) << text;
  return name;
}

std::string QuellCommand::read(const std::string& name) const {
  std::ostringstream out;
  out << std::ifstream(path(name), std::ios::binary).rdbuf();
  return out.str();
}

void QuellCommand::write_color(const std::string& name, int width, int height, float value) {
  Image image(quell_shape{width, height, 3});
  const quell_image view = image.view();
  for (int c = 0; c < 3; ++c)
    for (int y = 0; y < height; ++y) std::fill_n(view.plane[c] + y * view.pitch, width, value);
  write_image(path(name), view, QUELL_RADIANCE);
}

std::vector<std::string> QuellCommand::files(const std::string& folder) const {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(path(folder), error))
    if (!entry.is_directory()) names.push_back(fs::relative(entry.path(), path(folder)).string());
  std::ranges::sort(names);
  return names;
}

}  // namespace quell::test
