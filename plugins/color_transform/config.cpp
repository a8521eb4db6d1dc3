// Opens configurations, and makes the built-in one of OpenColorIO's own transforms.
#include "color_transform/config.h"

#include <cstdlib>
#include <initializer_list>
#include <stdexcept>
#include <vector>

#include "color_transform/names.h"

namespace quell::color {

namespace {

constexpr const char* kAces = "ACES2065-1";
constexpr const char* kLinearRec709 = "Linear Rec.709 (sRGB)";
constexpr const char* kSrgbDisplay = "sRGB - Display";
constexpr const char* kPlainView = "Un-tone-mapped";
constexpr const char* kAcesView = "ACES 1.0 - SDR Video";

ocio::BuiltinTransformRcPtr builtin(const char* style,
                                    ocio::TransformDirection direction = ocio::TRANSFORM_DIR_FORWARD) {
  auto transform = ocio::BuiltinTransform::Create();
  transform->setStyle(style);
  transform->setDirection(direction);
  return transform;
}

void add_scene_space(ocio::Config& config, const char* name, std::initializer_list<const char*> aliases,
                     const ocio::ConstTransformRcPtr& to_reference) {
  auto space = ocio::ColorSpace::Create(ocio::REFERENCE_SPACE_SCENE);
  space->setName(name);
  for (const char* alias : aliases) space->addAlias(alias);
  space->setEncoding("scene-linear");
  if (to_reference) space->setTransform(to_reference, ocio::COLORSPACE_DIR_TO_REFERENCE);
  config.addColorSpace(space);
}

void add_view(ocio::Config& config, const char* name, const ocio::ConstTransformRcPtr& from_reference) {
  auto view = ocio::ViewTransform::Create(ocio::REFERENCE_SPACE_SCENE);
  view->setName(name);
  view->setTransform(from_reference, ocio::VIEWTRANSFORM_DIR_FROM_REFERENCE);
  config.addViewTransform(view);
  config.addDisplayView(kSrgbDisplay, name, name, kSrgbDisplay, "", "", "");
}

// Named as OpenColorIO's own configurations name these spaces and views, so that graphs fit those too.
ocio::ConstConfigRcPtr built_in() {
  auto config = ocio::Config::Create();
  add_scene_space(*config, kAces, {"aces2065_1", "lin_ap0"}, nullptr);
  add_scene_space(*config, "ACEScg", {"lin_ap1"}, builtin("ACEScg_to_ACES2065-1"));
  auto rec709 = ocio::GroupTransform::Create();
  rec709->appendTransform(builtin("UTILITY - ACES-AP1_to_LINEAR-REC709_BFD", ocio::TRANSFORM_DIR_INVERSE));
  rec709->appendTransform(builtin("ACEScg_to_ACES2065-1"));
  add_scene_space(*config, kLinearRec709, {"lin_rec709_srgb", "lin_rec709", "lin_srgb"}, rec709);
  config->setRole(ocio::ROLE_SCENE_LINEAR, kLinearRec709);
  config->setRole(ocio::ROLE_DEFAULT, kLinearRec709);
  config->setRole("aces_interchange", kAces);

  auto display = ocio::ColorSpace::Create(ocio::REFERENCE_SPACE_DISPLAY);
  display->setName(kSrgbDisplay);
  display->setEncoding("sdr-video");
  display->setTransform(builtin("DISPLAY - CIE-XYZ-D65_to_sRGB"), ocio::COLORSPACE_DIR_FROM_REFERENCE);
  config->addColorSpace(display);
  add_view(*config, kAcesView, builtin("ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0"));
  add_view(*config, kPlainView, builtin("UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD"));
  config->setDefaultViewTransformName(kPlainView);
  config->validate();
  return config;
}

}  // namespace

Config open_config(const std::string& path) {
  const char* variable = std::getenv("OCIO");
  const bool from_variable = path.empty() && variable && *variable;
  const std::string file = from_variable ? variable : path;
  if (file.empty()) return {built_in(), "the built-in configuration"};
  try {
    return {ocio::Config::CreateFromFile(file.c_str()), "'" + file + "'"};
  } catch (const ocio::Exception& e) {
    throw std::runtime_error("cannot use the OpenColorIO configuration '" + file + "'" +
                             (from_variable ? ", which $OCIO names" : "") + ": " + e.what());
  }
}

std::string color_space(const Config& config, const char* param, const std::string& name) {
  const std::string wanted = name.empty() ? ocio::ROLE_SCENE_LINEAR : name;
  if (const auto space = config.config->getColorSpace(wanted.c_str())) return space->getName();
  std::vector<std::string> names;
  for (int i = 0; i < config.config->getNumColorSpaces(); ++i)
    names.emplace_back(config.config->getColorSpaceNameByIndex(i));
  if (name.empty())
    throw std::runtime_error(config.name + " has no role scene_linear; set `" + param + "`\n  " +
                             listed("it has the color spaces", "", names));
  throw std::runtime_error(std::string(param) + ": " + config.name + " has no color space '" + name + "'\n  " +
                           listed("it has", name, names));
}

}  // namespace quell::color
