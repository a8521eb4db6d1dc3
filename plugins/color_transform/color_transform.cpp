// Converts radiance from one color space to another.
#include <quell/node.h>

#include <limits>
#include <string>

#include "color_transform/config.h"
#include "color_transform/pixels.h"

namespace {

namespace color = quell::color;

struct ColorTransform {
  quell::In<quell::Radiance> image;
  quell::Out<quell::Radiance> converted;
  quell::Path config;
  quell::Text from, to{{"ACEScg", 6}};

  void describe(quell::Describe& d) {
    d.summary("Converts radiance from one color space of an OpenColorIO configuration to another.");
    d.source("OpenColorIO; the built-in configuration follows Academy S-2014-004 (ACEScg) and Bradford's adaptation.");
    d.in(image, "image", "Radiance in the color space `from`.");
    d.out(converted, "image",
          "Radiance in the color space `to`. A color outside its gamut has a component below 0, which becomes 0.")
        .passes(image);
    d.param(config, "config", color::kConfigDoc);
    d.param(from, "from", color::kFromDoc);
    d.param(to, "to", "The color space to convert to, likewise.");
  }

  color::Pixels prepare(const quell_spec&) const {
    const auto opened = color::open_config(config.c_str());
    const auto a = color::color_space(opened, "from", from.c_str()), b = color::color_space(opened, "to", to.c_str());
    return color::Pixels(opened.config->getProcessor(a.c_str(), b.c_str()));
  }

  void run(const quell::Tile& tile, const color::Pixels& pixels) const {
    pixels.run(tile, tile[image], tile[converted], std::numeric_limits<float>::max());
  }
};

}  // namespace
QUELL_PLUGIN("color_transform", ColorTransform)
