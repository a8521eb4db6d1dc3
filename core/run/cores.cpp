// Cores by affinity and by control groups.
#include "core/run/cores.h"

#include <sched.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace quell {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

bool lists(std::string_view commas, std::string_view word) {
  for (std::size_t at = 0; at <= commas.size();) {
    const auto end = std::min(commas.find(',', at), commas.size());
    if (commas.substr(at, end - at) == word) return true;
    at = end + 1;
  }
  return false;
}

// A hierarchy of groups that may hold quotas.
struct Hierarchy {
  bool unified = false;  // version 2
  fs::path mount, root;  // where it is seen, and which group that place shows
};

// Of /proc/self/mountinfo: id, parent, device, root, place, options…, "-", type, source, options.
std::vector<Hierarchy> hierarchies(const fs::path& root) {
  std::vector<Hierarchy> found;
  for (const auto& line : lines_of(root / "proc/self/mountinfo")) {
    std::istringstream words(line);
    std::string id, parent, device, shown, place, word, type, source, options;
    words >> id >> parent >> device >> shown >> place;
    while (words >> word && word != "-") {
    }
    words >> type >> source >> options;
    if (type == "cgroup2" || (type == "cgroup" && lists(options, "cpu")))
      found.push_back({type == "cgroup2", root / fs::path(place).relative_path(), shown});
  }
  return found;
}

// The group of this process in the hierarchy, of lines "id:controllers:group".
fs::path own_group(const fs::path& root, bool unified) {
  for (const auto& line : lines_of(root / "proc/self/cgroup")) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const auto controllers = std::string_view(line).substr(first + 1, second - first - 1);
    if (unified ? controllers.empty() : lists(controllers, "cpu")) return line.substr(second + 1);
  }
  return "/";
}

std::optional<int> quota_of(const fs::path& group, bool unified) {
  std::int64_t quota = 0, period = 0;  // microseconds; no number ("max") and -1 mean no limit
  if (unified) {
    std::ifstream(group / "cpu.max") >> quota >> period;
  } else {
    std::ifstream(group / "cpu.cfs_quota_us") >> quota;
    std::ifstream(group / "cpu.cfs_period_us") >> period;
  }
  if (quota <= 0 || period <= 0) return std::nullopt;
  // Up, for bands go to whichever thread is free: of a quota of 1.5 two threads use all, one would leave a third.
  const auto cores = quota / period + (quota % period != 0);
  return int(std::min<std::int64_t>(cores, std::numeric_limits<int>::max()));
}

}  // namespace

std::optional<int> quota_cores(const fs::path& root) {
  std::optional<int> least;
  for (const auto& h : hierarchies(root)) {
    // Inside a container the mount may show a group far down as its top; a group outside of what it shows is that top.
    auto below = own_group(root, h.unified).lexically_relative(h.root);
    if (below.empty() || *below.begin() == "..") below = ".";
    for (auto group = (h.mount / below).lexically_normal();; group = group.parent_path()) {
      if (const auto cores = quota_of(group, h.unified)) least = std::min(least.value_or(*cores), *cores);
      if (std::distance(group.begin(), group.end()) <= std::distance(h.mount.begin(), h.mount.end())) break;
    }
  }
  return least;
}

int usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  const int bound = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
  return std::max(1, std::min(bound, quota_cores().value_or(bound)));
}

}  // namespace quell
