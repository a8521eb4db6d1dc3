// Reads frames once and gives copies of them.
#include "tests/support/kept_frames.h"

#include <algorithm>

namespace quell::test {

KeptFrames::KeptFrames(FrameSource& source, std::vector<std::string> roles) : frames_(source.frames()) {
  if (roles.empty())
    for (const auto& [role, type] : source.roles()) roles.push_back(role);
  for (const auto& role : roles) roles_[role] = source.roles().at(role);
  for (const auto frame : frames_) {
    if (source.cut_before(frame)) cuts_.insert(frame);
    std::vector<Image> images;
    std::vector<quell_image> views;
    for (const auto& shape : source.shapes(frame, roles)) images.emplace_back(shape);
    for (const auto& image : images) views.push_back(image.view());
    source.read(frame, roles, views);
    for (std::size_t i = 0; i < roles.size(); ++i) images_[frame][roles[i]] = std::move(images[i]);
  }
}

void KeptFrames::add(const std::string& role, int type, const std::function<Image(std::int64_t)>& make) {
  roles_[role] = type;
  for (const auto frame : frames_) images_[frame][role] = make(frame);
}

std::vector<quell_shape> KeptFrames::shapes(std::int64_t frame, std::span<const std::string> roles) {
  std::vector<quell_shape> shapes;
  for (const auto& role : roles) shapes.push_back(image(frame, role).shape());
  return shapes;
}

void KeptFrames::read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) {
  for (std::size_t i = 0; i < roles.size(); ++i) {
    const Image& from = image(frame, roles[i]);
    for (int c = 0; c < from.channels(); ++c)
      for (int y = 0; y < from.height(); ++y)
        std::copy_n(from.row(c, y), from.width(), into[i].plane[c] + y * into[i].pitch);
  }
}

}  // namespace quell::test
