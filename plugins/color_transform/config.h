// The OpenColorIO configuration that a node uses: a file, $OCIO, or a small one of our own.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <string>

namespace quell::color {

namespace ocio = OCIO_NAMESPACE;

struct Config {
  ocio::ConstConfigRcPtr config;
  std::string name;  // for messages
};

// What a parameter `config` means; empty: the file that $OCIO names, or without that the built-in configuration. Throws
// with OpenColorIO's own words when a file cannot be used.
Config open_config(const std::string& path);

// The color space that `name` means in a parameter called `param`; empty: the role scene_linear. Throws a list of those
// that there are.
std::string color_space(const Config&, const char* param, const std::string& name);

// For the parameters of nodes.
inline constexpr const char* kConfigDoc =
    "An OpenColorIO configuration. Empty: the file that the environment variable OCIO names; without that, a built-in "
    "configuration: color spaces `Linear Rec.709 (sRGB)` (its role scene_linear), `ACEScg`, `ACES2065-1`; display "
    "`sRGB - Display` with the views `ACES 1.0 - SDR Video` and `Un-tone-mapped`.";
inline constexpr const char* kFromDoc =
    "The color space of the image: a name, alias or role of the configuration. Empty: the role scene_linear.";

}  // namespace quell::color
