#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "base/context.h"
#include "base/read_guard.h"
#include "queries/session/detail/saved_text.h"

namespace queries {

/// Keeps the files that a saved file would read, outside of its own folder, and refuses them unless the user has
/// allowed them. Hidden files (a part of the name below the folder begins with a point) count as outside, and so does
/// what symbolic links lead to. Several threads may ask; the rest is for one.
class RestoreGuard final : public algebra3d::ReadGuard {
 public:
  RestoreGuard(const SavedText& saved, bool allows_all);

  /// Errors: permission_denied.
  algebra3d::Status check(const std::filesystem::path& file) override;
  /// How often a file was refused.
  std::size_t refusal_count() const;
  /// Whether something was refused, a variable or a file.
  bool has_refused() const { return refusal_count() > 0 || !refused_variables_.empty(); }
  /// An object that could not be tried, since an object that it is derived from reads a refused file.
  void add_untried(const std::string& name) { untried_.insert(name); }
  /// An error that lists what the saved file would read, if something was refused; all of it stands in the notes as
  /// well. `is_shared`: the user cannot allow it. Errors: wrong_usage.
  algebra3d::Status verdict(bool is_shared, algebra3d::Context& context) const;

 private:
  const SavedText& saved_;
  const bool allows_all_;
  const std::filesystem::path folder_;  // without links
  std::vector<std::string> refused_variables_;
  mutable std::mutex mutex_;  // guards the next two
  std::set<std::string> refused_files_;
  std::size_t refusal_count_ = 0;
  std::set<std::string> untried_;
};

}  // namespace queries
