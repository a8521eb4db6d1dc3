// Shows radiance on a display by a view of an OpenColorIO configuration.
#include <quell/node.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "color_transform/config.h"
#include "color_transform/names.h"
#include "color_transform/pixels.h"

namespace {

namespace color = quell::color;
namespace ocio = quell::color::ocio;

std::string display_of(const color::Config& c, const std::string& name) {
  std::vector<std::string> names;
  for (int i = 0; i < c.config->getNumDisplays(); ++i) names.emplace_back(c.config->getDisplay(i));
  if (name.empty() && !names.empty()) return c.config->getDefaultDisplay();
  for (const auto& n : names)
    if (n == name) return n;
  throw std::runtime_error("display: " + c.name + " has no display '" + name + "'\n  " +
                           color::listed("it has", name, names));
}

std::string view_of(const color::Config& c, const std::string& display, const std::string& from,
                    const std::string& name) {
  if (name.empty()) return c.config->getDefaultView(display.c_str(), from.c_str());
  std::vector<std::string> names;
  for (int i = 0; i < c.config->getNumViews(display.c_str()); ++i)
    names.emplace_back(c.config->getView(display.c_str(), i));
  for (const auto& n : names)
    if (n == name) return n;
  throw std::runtime_error("view: display '" + display + "' of " + c.name + " has no view '" + name + "'\n  " +
                           color::listed("it has", name, names));
}

struct DisplayTransform {
  quell::In<quell::Radiance> image;
  quell::Out<quell::Display> shown;
  quell::Path config;
  quell::Text from, display, view;

  void describe(quell::Describe& d) {
    d.summary("Shows radiance on a display by a view of an OpenColorIO configuration, such as the ACES view for sRGB.");
    d.source("OpenColorIO; Academy TB-2014-004 and ACES 1.0's output transform for video.");
    d.in(image, "image", "Radiance in the color space `from`.");
    d.out(shown, "image", "What the display takes, clamped to [0,1].");
    d.param(config, "config", color::kConfigDoc);
    d.param(from, "from", color::kFromDoc);
    d.param(display, "display", "A display of the configuration. Empty: its default.");
    d.param(view, "view", "A view of the display. Empty: its default, in the built-in configuration the ACES view.");
  }

  color::Pixels prepare(const quell_spec&) const {
    const auto opened = color::open_config(config.c_str());
    const auto space = color::color_space(opened, "from", from.c_str());
    const auto on = display_of(opened, display.c_str());
    const auto transform = ocio::DisplayViewTransform::Create();
    transform->setSrc(space.c_str());
    transform->setDisplay(on.c_str());
    transform->setView(view_of(opened, on, space, view.c_str()).c_str());
    return color::Pixels(opened.config->getProcessor(transform));
  }

  void run(const quell::Tile& tile, const color::Pixels& pixels) const {
    pixels.run(tile, tile[image], tile[shown], 1.0f);
  }
};

}  // namespace
QUELL_PLUGIN("display_transform", DisplayTransform)
