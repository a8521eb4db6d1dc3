// Runs the path tracer on the room.
#include "tests/support/trace_room.h"

#include "core/run/node_source.h"
#include "tests/support/paths.h"
#include "tests/support/run_node.h"

namespace quell::test {

std::vector<Image> trace_room(const RoomFrame& f, const std::vector<std::string>& roles) {
  const auto* type = registry().find("path_tracer");
  Instance instance(*type);
  for (const auto& [name, value] :
       {std::pair{"width", f.width}, {"height", f.height}, {"spp", f.spp}, {"seed", f.seed}})
    instance.set_int(type->find_param(name), value);
  instance.set_text(type->find_param("scene"), QUELL_TEST_SOURCE "/graphs/scenes/room.json");
  NodeSource source(std::move(instance), {f.frame}, {}, 0, nullptr);
  std::vector<Image> images;
  std::vector<quell_image> views;
  for (const auto& shape : source.shapes(f.frame, roles)) images.emplace_back(shape);
  for (auto& image : images) views.push_back(image.view());
  source.read(f.frame, roles, views);
  return images;
}

}  // namespace quell::test
