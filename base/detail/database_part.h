#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace algebra3d {

/// The reason why the file at `path` must not be replaced: it is a SQLite database or a file beside one (`-wal`,
/// `-shm`, `-journal`), or its name would make it one; nothing if it may be replaced. Decided by the databases open in
/// this process, by the names of databases beside it, and by the first bytes, so that links and databases of other
/// processes are recognised. `path` must not be a symbolic link.
std::optional<std::string> database_part(const std::filesystem::path& path);

}  // namespace algebra3d
