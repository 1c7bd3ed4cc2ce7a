#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace stl {

/// Why no other file may take the place of the one at `path`: it is a SQLite database, or what SQLite keeps beside one
/// (`-wal`, `-shm`, `-journal`), or would be if it were made; nothing if any file may. Told by the databases that this
/// process has open, by the name beside a database, and by the first bytes, so that no link and no other process's
/// database is missed. `path` is no symbolic link.
std::optional<std::string> database_part(const std::filesystem::path& path);

}  // namespace stl
