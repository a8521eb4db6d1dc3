// Runs graphs over frames in memory and takes the means of what is measured of each frame.
#include "tests/support/judged_frames.h"

#include <quell/types.h>

#include "tests/support/data_sequence.h"
#include "tests/support/picture_metrics.h"
#include "tests/support/run_node.h"
#include "tests/support/run_shipped.h"
#include "tests/support/trace_room.h"

#include <algorithm>
#include <utility>

namespace quell::test {

Pictures JudgedFrames::run(const std::string& graph, std::vector<Edit> edits) {
  Pictures pictures;
  run_shipped(graph, std::move(edits), frames_, [&](std::int64_t frame, const FrameOutputs& outputs) {
    const quell_image& color = outputs.at("color");
    Image kept(color.width, color.height, color.channels);
    for (int c = 0; c < color.channels; ++c)
      for (int y = 0; y < color.height; ++y) std::copy_n(color.plane[c] + y * color.pitch, color.width, kept.row(c, y));
    pictures[frame] = std::move(kept);
  });
  return pictures;
}

Quality JudgedFrames::judge(const Pictures& pictures) const {
  Quality mean;
  const double share = 1.0 / double(references_.size());
  for (const auto& [frame, halves] : references_) {
    const Reference reference{halves.a, halves.b};
    const Image& picture = pictures.at(frame);
    mean.psnr += share * psnr(picture, reference);
    mean.relative_error += share * relative_error(picture, reference);
    mean.brightness_error += share * brightness_error(picture, reference);
  }
  int steps = 0;
  for (const auto frame : frames_.frames()) {
    if (frames_.cut_before(frame)) continue;
    mean.flicker += flicker(pictures.at(frame), pictures.at(frame - 1), frames_.image(frame, "motion"),
                            frames_.image(frame, "id"), frames_.image(frame - 1, "id"));
    ++steps;
  }
  mean.flicker /= std::max(steps, 1);
  return mean;
}

JudgedFrames judged_scene(const std::string& scene, const std::vector<std::int64_t>& frames,
                          const std::set<std::int64_t>& cuts, const std::vector<std::int64_t>& judged, int spp,
                          int width, int height) {
  const auto source = trace_scene(scene, frames, cuts, {1, 0, width, height});
  std::map<std::int64_t, ReferenceHalves> references;
  for (const auto frame : judged) {
    const auto half = [&](int seed) {
      const auto traced = trace_scene(scene, {frame}, {}, {spp, seed, width, height});
      return KeptFrames(*traced, {"color"}).image(frame, "color").copy();
    };
    references[frame] = {half(1001), half(1002)};
  }
  return {KeptFrames(*source), std::move(references)};
}

JudgedFrames judged_cycles_cornell() {
  DataSequence room("cycles-cornell", "cycles-cornell");
  std::vector<std::string> roles;  // a reference is not there for every frame
  for (const auto& [role, type] : room.files().roles())
    if (!role.starts_with("reference")) roles.push_back(role);
  std::map<std::int64_t, ReferenceHalves> references;
  for (const auto frame : room.files().reference_frames())
    references[frame] = {room.read(frame, "reference_a"), room.read(frame, "reference_b")};
  KeptFrames frames(room.files(), roles);
  frames.add("position", QUELL_POSITION, [&](std::int64_t frame) {
    const auto &depth = frames.image(frame, "depth"), &camera = frames.image(frame, "camera");
    return Node("position_from_depth").in("depth", depth).in("camera", camera).run("position");
  });
  return {std::move(frames), std::move(references)};
}

}  // namespace quell::test
