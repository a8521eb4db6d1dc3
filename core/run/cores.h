// How many cores this process may keep busy.
#pragma once

#include <filesystem>
#include <optional>

namespace quell {

// What the control groups of this process, and all groups above them, grant of CPU time: the least quota, in cores,
// rounded up; nothing where none is set. Reads version 2 (cpu.max) and version 1 (cpu.cfs_quota_us) as /proc and the
// mounts below `root` show them.
std::optional<int> quota_cores(const std::filesystem::path& root = "/");

// The cores that the process is bound to, and no more than its quota pays for. At least 1.
int usable_cores();

}  // namespace quell
