// What the executor reads frames from: files by a sequence, or a source node.
#pragma once

#include <quell/abi.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace quell {

// What the way in had to repair, per role.
struct Repairs {
  std::int64_t non_finite = 0;  // pixels with NaN or Inf, replaced
  std::int64_t negative = 0;    // pixels with negative radiance, raised to 0
};

// A file that a frame is made from.
struct FileRead {
  std::int64_t frame;
  std::string name;                // as FrameSource::description() has it
  std::string hash;                // of its bytes (core/sequence/file_hash.h)
  std::vector<std::string> roles;  // that it was read for
};
using FileWatcher = std::function<void(const FileRead&)>;

class FrameSource {
 public:
  virtual ~FrameSource() = default;

  // Frame numbers in the order in which they run.
  virtual const std::vector<std::int64_t>& frames() const = 0;
  // History ends before this frame: a declared cut or a gap in the numbers. True for the first.
  virtual bool cut_before(std::int64_t frame) const = 0;
  // The sequence itself declares a cut before this frame (so that even a run that goes on from saved state starts
  // anew).
  virtual bool declared_cut(std::int64_t) const { return false; }
  // Roles that it provides, with their quell_type.
  virtual const std::map<std::string, int>& roles() const = 0;
  // Shape of each role in `roles`, in that order, for this frame; opens headers only. Throws Error(Exit::input).
  virtual std::vector<quell_shape> shapes(std::int64_t frame, std::span<const std::string> roles) = 0;
  // Fills one image per role, in the conventions of <quell/types.h>. May run on another thread while another frame
  // is filtered; one call at a time. Throws Error(Exit::input).
  virtual void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) = 0;
  // From now on `read` throws Error(Exit::input) where a pixel of one of these roles is not finite, and says which,
  // in place of repairing it: what a metric judges by must not be made up. Sources that make their frames make finite
  // ones.
  virtual void refuse_non_finite(std::span<const std::string>) {}
  // Totals so far, by role.
  virtual std::map<std::string, Repairs> repairs() const = 0;

  // What these roles of the frames are read from, as a sequence file that stands for itself; "" where none can say it.
  // `graphs` is the folder of installed graphs, whose files are named "quell:…".
  virtual std::string description(const std::filesystem::path& /*graphs*/,
                                  std::span<const std::string> /*roles*/) const {
    return "";
  }
  // Node types that make these roles, with their plugins' versions; none where files hold them.
  virtual std::map<std::string, std::string> plugins(std::span<const std::string> /*roles*/) const { return {}; }
  // Hashes files from now on, before they are read and on the thread that reads them, and tells of each.
  virtual void watch_files(FileWatcher) {}
};

}  // namespace quell
