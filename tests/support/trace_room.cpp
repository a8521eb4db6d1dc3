// Runs the path tracer on the built-in scenes.
#include "tests/support/trace_room.h"

#include "core/run/node_source.h"
#include "tests/support/paths.h"
#include "tests/support/run_node.h"

namespace quell::test {

std::unique_ptr<FrameSource> trace_scene(const std::string& scene, const std::vector<std::int64_t>& frames,
                                         const std::set<std::int64_t>& cuts, const Tracing& t) {
  const auto* type = registry().find("path_tracer");
  Instance instance(*type);
  for (const auto& [name, value] :
       {std::pair{"width", t.width}, {"height", t.height}, {"spp", t.spp}, {"seed", t.seed}})
    instance.set_int(type->find_param(name), value);
  instance.set_text(type->find_param("scene"), QUELL_TEST_SOURCE "/graphs/scenes/" + scene + ".json");
  return std::make_unique<NodeSource>(std::move(instance), frames, cuts, 0, nullptr);
}

std::vector<Image> trace_room(const RoomFrame& f, const std::vector<std::string>& roles) {
  const auto source = trace_scene("room", {f.frame}, {}, {f.spp, f.seed, f.width, f.height});
  std::vector<Image> images;
  std::vector<quell_image> views;
  for (const auto& shape : source->shapes(f.frame, roles)) images.emplace_back(shape);
  for (auto& image : images) views.push_back(image.view());
  source->read(f.frame, roles, views);
  return images;
}

}  // namespace quell::test
