#pragma once

#include <cstddef>
#include <filesystem>

namespace algebra3d {

/// The memory of the machine in bytes, or that of the process's control group or one above it if that is less. 1 GB if
/// the system says neither.
std::size_t available_memory();

/// The smallest limit of the control groups that a file like /proc/self/cgroup names, below `root` (/sys/fs/cgroup);
/// SIZE_MAX if there is none.
std::size_t control_group_limit(const std::filesystem::path& groups, const std::filesystem::path& root);

}  // namespace algebra3d
