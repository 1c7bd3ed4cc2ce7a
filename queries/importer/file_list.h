#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "algebra3d/base/error.h"

namespace queries {

/// One file to be imported.
struct ListedFile {
  std::filesystem::path path;  ///< absolute and lexically normal; symbolic links are not resolved
  std::uint64_t size = 0;      ///< when listed, 0 if unknown; for the progress only
};

struct FileList {
  std::vector<ListedFile> files;            ///< sorted by the bytes of the path, without duplicates
  std::vector<std::string> unread_folders;  ///< "FOLDER: reason", sorted
  /// Ignored files in folders, by ending: ".txt" in lower case, "no ending", "link to a folder".
  std::map<std::string, std::uint64_t> skipped;
  std::vector<std::filesystem::path> folders;   ///< given folders, absolute and lexically normal, without a final /
  std::vector<std::filesystem::path> patterns;  ///< given patterns, likewise

  /// Whether a file, existing or not, matches the given folders and patterns.
  bool covers(const std::filesystem::path& file) const;
};

/// The ignored files as text: "3 .txt, 1 .ply", the most frequent first.
std::string skipped_text(const std::map<std::string, std::uint64_t>& skipped);

/// Expands `paths` to files. A folder stands for all files below it with endings of mesh files
/// (mesh_formats/mesh_formats.h); symbolic links to folders are not followed. A file given by name or by a pattern is
/// listed whatever its ending. An existing path is never treated as a pattern. Errors: file_missing for a path that
/// does not exist, a pattern without matches, or no files at all; wrong_usage for a path that is neither file nor
/// folder.
algebra3d::Result<FileList> list_files(std::span<const std::string> paths);

/// The path as UTF-8 text: invalid bytes become \xNN, so that different paths stay different in practice.
std::string path_text(const std::filesystem::path& path);

}  // namespace queries
