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
  std::filesystem::path path;  ///< absolute and lexically normal; symbolic links stay as they were written
  std::uint64_t size = 0;      ///< when it was listed, 0 if unknown: for the progress only
};

struct FileList {
  std::vector<ListedFile> files;            ///< sorted by the bytes of the path, each once
  std::vector<std::string> unread_folders;  ///< "FOLDER: reason", sorted
  /// Files in folders that were not taken, by ending: ".txt" in lower case, "no ending", "link to a folder".
  std::map<std::string, std::uint64_t> skipped;
  std::vector<std::filesystem::path> folders;   ///< those given, absolute and lexically normal, without a last /
  std::vector<std::filesystem::path> patterns;  ///< the same of the patterns given

  /// Whether the file was meant by the given folders and patterns, be it there or not.
  bool covers(const std::filesystem::path& file) const;
};

/// "3 .txt, 1 .ply", the most first.
std::string skipped_text(const std::map<std::string, std::uint64_t>& skipped);

/// The files that `paths` mean. A folder means all files below it whose names end in .stl, .obj or .off (upper or lower
/// case); symbolic links to folders are not entered there. A file given by name or by a pattern is taken whatever its
/// name. A path that exists is never read as a pattern. Changes nothing. Errors: file_missing for a path that does not
/// exist, a pattern that nothing matches, or if all paths together mean no file; wrong_usage for a path that is neither
/// file nor folder.
algebra3d::Result<FileList> list_files(std::span<const std::string> paths);

/// The path as UTF-8 text: bytes that are none become \xNN, so that different paths stay different in practice.
std::string path_text(const std::filesystem::path& path);

}  // namespace queries
