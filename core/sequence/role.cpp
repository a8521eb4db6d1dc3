// The tables behind roles.
#include "core/sequence/role.h"

#include <quell/types.h>

namespace quell {

namespace {

struct Role {
  std::string_view name;
  int type;
};

constexpr Role kRoles[] = {
    {"color", QUELL_RADIANCE},      {"color_a", QUELL_RADIANCE},   {"color_b", QUELL_RADIANCE},
    {"diffuse", QUELL_RADIANCE},    {"specular", QUELL_RADIANCE},  {"emission", QUELL_RADIANCE},
    {"direct", QUELL_RADIANCE},     {"indirect", QUELL_RADIANCE},  {"environment", QUELL_RADIANCE},
    {"spec_albedo", QUELL_ALBEDO},  {"motion_next", QUELL_MOTION}, {"material_id", QUELL_ID},
    {"roughness", QUELL_SCALAR},    {"alpha", QUELL_SCALAR},       {"spp", QUELL_SCALAR},
    {"hit_distance", QUELL_SCALAR},
};

// Types that files can hold.
bool in_files(const TypeInfo& t) {
  return (t.storage == Storage::pixels || t.storage == Storage::table) && t.type != QUELL_TAPS;
}

}  // namespace

int type_of_role(std::string_view role) {
  for (const Role& r : kRoles)
    if (r.name == role) return r.type;
  const TypeInfo* type = type_info(role);
  return type && in_files(*type) ? int(type->type) : 0;
}

std::vector<std::string> known_roles() {
  std::vector<std::string> names;
  for (const Role& r : kRoles) names.emplace_back(r.name);
  for (const TypeInfo& t : kTypes)
    if (in_files(t)) names.emplace_back(t.name);
  return names;
}

std::vector<std::vector<std::string>> usual_channels(int type) {
  switch (type) {
    case QUELL_RADIANCE:
    case QUELL_ALBEDO:
    case QUELL_DISPLAY:
      return {{"R", "G", "B"}, {"r", "g", "b"}};
    case QUELL_NORMAL:
    case QUELL_POSITION:
      return {{"X", "Y", "Z"}, {"R", "G", "B"}, {"x", "y", "z"}, {"r", "g", "b"}};
    case QUELL_MOTION:
    case QUELL_SLOPE:
    case QUELL_MOMENTS:
      return {{"X", "Y"}, {"R", "G"}, {"x", "y"}, {"r", "g"}};
    case QUELL_DEPTH:
      return {{"Z"}, {"Y"}, {"R"}, {"z"}, {"r"}};
    case QUELL_ID:
    case QUELL_VARIANCE:
    case QUELL_COUNT:
    case QUELL_SCALAR:
      return {{"Y"}, {"R"}, {"X"}, {"r"}};
    default:
      return {};
  }
}

}  // namespace quell
