// The table that core/sequence/image_formats.h asks for.
#include "core/sequence/image_formats.h"

#include "core/image_formats/oiio_reader.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <stdexcept>

namespace quell {

namespace {

namespace oiio = OIIO;

std::vector<unsigned char> encode_png(int width, int height, int channels, std::span<const std::uint8_t> pixels,
                                      const std::map<std::string, std::string>& metadata) {
  oiio::Filesystem::IOVecOutput bytes;
  const auto output = oiio::ImageOutput::create("png");  // gone before the bytes that it writes to
  if (!output) throw std::runtime_error(oiio::geterror());
  oiio::ImageSpec spec(width, height, channels, oiio::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  for (const auto& [key, value] : metadata) spec.attribute(key, value);
  // The time of writing, which OpenImageIO adds, would make equal images unequal files.
  spec.attribute("DateTime", "");
  output->set_ioproxy(&bytes);
  if (!output->open("image.png", spec) || !output->write_image(oiio::TypeDesc::UINT8, pixels.data()) ||
      !output->close())
    throw std::runtime_error(output->geterror());
  return bytes.buffer();
}

}  // namespace

}  // namespace quell

extern "C" __attribute__((visibility("default"))) const quell::ImageFormats* quell_image_formats() {
  static const quell::ImageFormats formats = [] {
    // The host owns all threads.
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    return quell::ImageFormats{QUELL_VERSION, quell::open_by_oiio, quell::encode_png};
  }();
  return &formats;
}
