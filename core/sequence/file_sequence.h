// Frames read from files, in the conventions of <quell/types.h>.
#pragma once

#include "core/report/diagnostics.h"
#include "core/sequence/frame_source.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace quell {

struct Sequence;

// What to do about a frame whose file is missing: --missing error|skip|hold|black.
enum class Missing {
  error,
  skip,   // leave the frame out; history ends
  hold,   // the file of the nearest frame before (or else after) stands in
  black,  // all roles read as misses; history ends before the frame and after it
};
std::optional<Missing> missing_from_name(std::string_view name);
inline constexpr std::string_view kMissingNames[] = {"error", "skip", "hold", "black"};

class FileSequence : public FrameSource {
 public:
  ~FileSequence() override;

  const std::vector<std::int64_t>& frames() const override;
  bool cut_before(std::int64_t frame) const override;
  bool declared_cut(std::int64_t frame) const override;
  const std::map<std::string, int>& roles() const override;
  std::vector<quell_shape> shapes(std::int64_t frame, std::span<const std::string> roles) override;
  void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) override;
  void refuse_non_finite(std::span<const std::string> roles) override;
  std::map<std::string, Repairs> repairs() const override;
  std::string description(const std::filesystem::path& graphs, std::span<const std::string> roles) const override;
  void watch_files(FileWatcher) override;

  // Frames for which all files of the reference exist.
  const std::vector<std::int64_t>& reference_frames() const;
  // Frames whose files were missing, for reports: skipped, held or black.
  const std::vector<std::int64_t>& missing_frames() const;

 private:
  friend std::unique_ptr<FileSequence> open_sequence(const Sequence&, std::span<const std::string>, Missing,
                                                     Diagnostics&);
  class Impl;
  explicit FileSequence(std::unique_ptr<Impl>);
  std::unique_ptr<Impl> impl_;
};

}  // namespace quell
