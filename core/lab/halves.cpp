// Reads both halves and writes their mean.
#include "core/lab/halves.h"

#include "core/image/image.h"

#include <algorithm>
#include <vector>

namespace quell {

namespace {

class MeanOfHalves : public FrameSource {
 public:
  explicit MeanOfHalves(std::unique_ptr<FrameSource> source) : source_(std::move(source)), roles_(source_->roles()) {
    roles_[std::string(kReference)] = roles_.at(std::string(kReferenceHalves[0]));
  }

  const std::vector<std::int64_t>& frames() const override { return source_->frames(); }
  bool cut_before(std::int64_t frame) const override { return source_->cut_before(frame); }
  bool declared_cut(std::int64_t frame) const override { return source_->declared_cut(frame); }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::map<std::string, Repairs> repairs() const override { return source_->repairs(); }
  void refuse_non_finite(std::span<const std::string> roles) override { source_->refuse_non_finite(read_for(roles)); }
  // Reading it makes the mean again.
  std::string description(const std::filesystem::path& graphs, std::span<const std::string> roles) const override {
    return source_->description(graphs, read_for(roles));
  }
  std::map<std::string, std::string> plugins(std::span<const std::string> roles) const override {
    return source_->plugins(read_for(roles));
  }
  void watch_files(FileWatcher watcher) override {
    source_->watch_files([watcher](const FileRead& read) {
      FileRead here = read;
      if (std::ranges::any_of(read.roles, is_reference)) here.roles.emplace_back(kReference);
      watcher(here);
    });
  }

  std::vector<quell_shape> shapes(std::int64_t frame, std::span<const std::string> roles) override {
    std::vector<std::string> theirs(roles.begin(), roles.end());
    std::ranges::replace(theirs, kReference, std::string(kReferenceHalves[0]));
    return source_->shapes(frame, theirs);
  }

  void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) override {
    const auto place = std::ranges::find(roles, kReference) - roles.begin();
    if (place == std::ssize(roles)) return source_->read(frame, roles, into);
    // Halves go where they are wanted for themselves, or else aside.
    std::vector<std::string> names(roles.begin(), roles.end());
    std::vector<quell_image> images(into.begin(), into.end());
    names.erase(names.begin() + place), images.erase(images.begin() + place);
    const quell_image& mean = into[std::size_t(place)];
    Image own[2];
    quell_image half[2];
    for (int i = 0; i < 2; ++i) {
      const auto at = std::ranges::find(names, kReferenceHalves[i]) - names.begin();
      if (at < std::ssize(names)) {
        half[i] = images[std::size_t(at)];
        continue;
      }
      own[i] = Image(mean.width, mean.height, mean.channels);
      half[i] = own[i].view();
      names.emplace_back(kReferenceHalves[i]), images.push_back(half[i]);
    }
    source_->read(frame, names, images);
    for (int c = 0; c < mean.channels; ++c)
      for (int y = 0; y < mean.height; ++y)
        for (int x = 0; x < mean.width; ++x) {
          const auto at = y * mean.pitch + x;
          mean.plane[c][at] =
              0.5f * half[0].plane[c][y * half[0].pitch + x] + 0.5f * half[1].plane[c][y * half[1].pitch + x];
        }
  }

 private:
  // What is read of the source: halves for their mean.
  static std::vector<std::string> read_for(std::span<const std::string> roles) {
    std::vector<std::string> theirs(roles.begin(), roles.end());
    if (std::erase(theirs, kReference))
      for (const auto half : kReferenceHalves)
        if (std::ranges::find(theirs, half) == theirs.end()) theirs.emplace_back(half);
    return theirs;
  }

  std::unique_ptr<FrameSource> source_;
  std::map<std::string, int> roles_;
};

}  // namespace

std::unique_ptr<FrameSource> with_mean_of_halves(std::unique_ptr<FrameSource> source) {
  const auto& roles = source->roles();
  const auto has = [&](std::string_view role) { return roles.contains(std::string(role)); };
  if (has(kReference) || !has(kReferenceHalves[0]) || !has(kReferenceHalves[1])) return source;
  return std::make_unique<MeanOfHalves>(std::move(source));
}

}  // namespace quell
