#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace queries {

/// The commands that were typed, kept in a file between sessions: one line per entry, a line end inside an entry is
/// written as `\n` and a backslash as `\\`. The file and its folder are made for their owner alone. Each entry is
/// appended at once, so that sessions side by side keep what both have typed. A file that cannot be read or written
/// costs the history and nothing else. Used by one thread.
class CommandHistory {
 public:
  static constexpr std::size_t kMostEntries = 2000;

  /// Reads the file, and shortens it to the newest `kMostEntries` once it has grown to twice as many. An empty path:
  /// the history lives as long as the session.
  explicit CommandHistory(std::filesystem::path file);

  /// Oldest first.
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
