#include "base/detail/machine_memory.h"

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string>

namespace algebra3d {
namespace {

namespace fs = std::filesystem;

// "max" is not a number: there is no limit.
std::size_t limit_in(const fs::path& file) {
  std::ifstream stream(file);
  std::size_t limit = 0;
  return stream >> limit ? limit : SIZE_MAX;
}

/// The limits of a group and of those above it: each holds for all below.
std::size_t limit_of_group(const fs::path& root, fs::path group, const char* file) {
  std::size_t least = limit_in(root / file);
  for (; !group.empty() && group != group.parent_path(); group = group.parent_path())
    least = std::min(least, limit_in(root / group / file));
  return least;
}

}  // namespace

// Lines "0::/group" of version 2, and "5:memory,cpu:/group" of version 1. In a container the group may be given from
// outside; then its files are at the root.
std::size_t control_group_limit(const fs::path& groups, const fs::path& root) {
  std::size_t least = SIZE_MAX;
  std::ifstream stream(groups);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos || second + 1 >= line.size()) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const fs::path group = fs::path(line.substr(second + 1)).relative_path();
    if (controllers == ",,") least = std::min(least, limit_of_group(root, group, "memory.max"));
    if (controllers.find(",memory,") != std::string::npos)
      least = std::min(least, limit_of_group(root / "memory", group, "memory.limit_in_bytes"));
  }
  return least;
}

std::size_t available_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long page_bytes = sysconf(_SC_PAGESIZE);
  constexpr std::size_t kIfUnknown = std::size_t{1} << 30U;
  const bool is_known = pages > 0 && page_bytes > 0;
  const std::size_t machine =
      is_known ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(page_bytes) : kIfUnknown;
  return std::min(machine, control_group_limit("/proc/self/cgroup", "/sys/fs/cgroup"));
}

}  // namespace algebra3d
