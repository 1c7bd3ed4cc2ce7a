#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_content.h"

namespace queries {

/// The text of a saved file, with the values of environment variables in place of `$(NAME)` where it has any. A file
/// that begins with the comment of this program has none.
class SavedText {
 public:
  /// `name`: the file as the user called it, for messages. Errors: those of reading a file.
  static algebra3d::Result<SavedText> open(const std::filesystem::path& file, std::string name,
                                           const std::atomic<bool>* cancel);
  std::string_view text() const { return variables_.empty() ? file_.bytes() : std::string_view(copy_); }
  const std::string& name() const { return name_; }
  /// The folder in which the file lies.
  const std::filesystem::path& folder() const { return folder_; }
  /// The names of the environment variables that the text asks for, sorted, also of those that are not set.
  const std::vector<std::string>& variables() const { return variables_; }

 private:
  SavedText(algebra3d::FileContent file, std::string name, std::filesystem::path folder);

  algebra3d::FileContent file_;
  std::string name_;
  std::filesystem::path folder_;
  std::vector<std::string> variables_;
  std::string copy_;  // the text with their values, if there are any
};

}  // namespace queries
