#include "queries/shell/detail/command_history.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string_view>
#include <system_error>

namespace queries {
namespace {

constexpr int kOwnerOnly = 0600;

std::string escaped(std::string_view command) {
  std::string line;
  for (const char c : command) {
    if (c == '\\')
      line += "\\\\";
    else if (c == '\n')
      line += "\\n";
    else
      line += c;
  }
  return line + "\n";
}

std::string unescaped(std::string_view line) {
  std::string command;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_escape = line[i] == '\\' && i + 1 < line.size();
    if (is_escape) ++i;
    command += is_escape && line[i] == 'n' ? '\n' : line[i];
  }
  return command;
}

// One call of write, so that the lines of two sessions do not mix.
bool write_file(const std::filesystem::path& file, int mode, const std::string& content) {
  const int handle = open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | mode, kOwnerOnly);
  if (handle < 0) return false;
  const bool is_written = write(handle, content.data(), content.size()) == static_cast<ssize_t>(content.size());
  return close(handle) == 0 && is_written;
}

void make_private_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::create_directories(folder, error))
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all, error);
}

}  // namespace

CommandHistory::CommandHistory(std::filesystem::path file) : file_(std::move(file)) {
  if (file_.empty()) return;
  make_private_folder(file_.parent_path());
  std::ifstream input(file_);
  for (std::string line; std::getline(input, line);) entries_.push_back(unescaped(line));
  const bool is_long = entries_.size() >= 2 * kMostEntries;
  if (entries_.size() > kMostEntries) entries_.erase(entries_.begin(), entries_.end() - kMostEntries);
  if (is_long) rewrite();
}

bool CommandHistory::add(const std::string& command) {
  const bool is_blank = command.find_first_not_of(" \t\r\n") == std::string::npos;
  if (is_blank || (!entries_.empty() && entries_.back() == command)) return false;
  entries_.push_back(command);
  if (!file_.empty()) write_file(file_, O_APPEND, escaped(command));
  return true;
}

void CommandHistory::rewrite() const {
  std::string content;
  for (const std::string& entry : entries_) content += escaped(entry);
  std::filesystem::path shorter = file_;
  shorter += "." + std::to_string(getpid());
  std::error_code error;
  if (write_file(shorter, O_TRUNC, content)) std::filesystem::rename(shorter, file_, error);
  std::filesystem::remove(shorter, error);
}

std::filesystem::path history_file() {
  const char* state = std::getenv("XDG_STATE_HOME");  // NOLINT(concurrency-mt-unsafe)
  const char* home = std::getenv("HOME");             // NOLINT(concurrency-mt-unsafe)
  std::filesystem::path folder;
  if (state != nullptr && *state == '/')
    folder = state;
  else if (home != nullptr && *home == '/')
    folder = std::filesystem::path(home) / ".local/state";
  return folder.empty() ? folder : folder / "algebra3d/history";
}

}  // namespace queries
