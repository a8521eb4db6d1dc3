// Shows one number a pixel as a colour.
#include <quell/node.h>

#include <stdexcept>
#include <string>

#include "false_color/false_color_kernels.h"

namespace {

struct FalseColor {
  quell::In<quell::Any> image;
  quell::In<quell::Value> stops;
  quell::Out<quell::Display> display;
  int channel = 0;
  quell::ColorScale scale;

  void describe(quell::Describe& d) {
    using quell::ColorMap;
    d.summary("Shows a channel of any image as colours, for depth, variance, counts and the like.");
    d.source("Mikhailov 2019, Turbo, An Improved Rainbow Colormap: his polynomial fit.");
    d.in(image, "image", "What to show. Numbers of 5e29 and more, as depth has where nothing was hit, become black.");
    d.in(stops, "stops",
         "Of a logarithmic scale: stops to add to each number, as `auto_exposure` with key 1 gives them to centre a "
         "frame.")
        .optional()
        .anywhere();
    d.out(display, "image", "Colours for an sRGB display.");
    d.param(channel, "channel", "Which channel, from 0.").range(0, 65535);
    d.param(scale.map, "map", "turbo: blue over green to red. grey: black to white.", {"turbo", "grey"});
    d.param(scale.logarithmic, "log", "Spreads log2 of the numbers, in place of the numbers, over the colours.");
    d.param(scale.low, "low", "What gets the first colour: a number of the image's unit or, with `log`, its log2.")
        .range(-1e30, 1e30);
    d.param(scale.high, "high", "What gets the last colour, in the same unit.").range(-1e30, 1e30);
  }

  void shapes(const quell_spec& spec, quell_shape*) const {
    if (!(scale.low < scale.high)) throw std::runtime_error("low must be below high");
    // Zero before the shape is known.
    if (const int channels = spec.in[image.index].channels; channels > 0 && channel >= channels)
      throw std::runtime_error("there is no channel " + std::to_string(channel) + ": the image has " +
                               std::to_string(channels) + ", from 0");
  }

  void run(const quell::Tile& tile) const {
    const float more = tile.has(stops) ? *tile.row(stops, 0, 0) : 0.0f;
    for (int y = tile.y0; y < tile.y1; ++y) {
      float* const out[3] = {tile.row(display, 0, y), tile.row(display, 1, y), tile.row(display, 2, y)};
      quell::color_row(scale, more, tile.x0, tile.x1, tile.row(image, channel, y), out);
    }
  }
};

}  // namespace
QUELL_PLUGIN("false_color", FalseColor)
