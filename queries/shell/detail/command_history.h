#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace queries {

/// The history of typed commands, kept in a file between sessions: one line per entry, with `
/// ` for a line end and `\\` for a backslash. File and folder are created readable for their owner only. Each entry is
/// appended immediately, so that parallel sessions share the file. If the file cannot be read or written, there is only
/// no history. Used by one thread.
class CommandHistory {
 public:
  static constexpr std::size_t kMostEntries = 2000;

  /// Reads the file, and shortens it to the newest `kMostEntries` when it has twice as many. An empty path: no file.
  explicit CommandHistory(std::filesystem::path file);

  /// The entries, oldest first.
  const std::vector<std::string>& entries() const { return entries_; }
  /// Appends a command, unless it is blank or equals the last one; true if it was appended.
  bool add(const std::string& command);

 private:
  void rewrite() const;

  std::filesystem::path file_;
  std::vector<std::string> entries_;
};

/// `$XDG_STATE_HOME/algebra3d/history`, or the same in `~/.local/state`; empty if there is no home.
std::filesystem::path history_file();

}  // namespace queries
