// The files that a saved file reads beside itself, when it is restored.
#include "queries/session/detail/restore_guard.h"

#include <algorithm>
#include <iterator>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "algebra3d/values/types/utf8.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Status;
namespace fs = std::filesystem;

/// Of each kind in the error; the notes have all.
constexpr std::size_t kMostNamed = 10;

/// Without links, and absolute; empty if that cannot be found out.
fs::path real_path(const fs::path& file) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(fs::absolute(file, error), error);
  return error ? fs::path() : real;
}

bool is_hidden(const fs::path& part) {
  return part != "." && part.native().starts_with('.');
}

bool is_visible_below(const fs::path& folder, const fs::path& file) {
  if (folder.empty() || file.empty()) return false;
  const auto [in_folder, in_file] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return in_folder == folder.end() && std::none_of(in_file, file.end(), is_hidden);
}

/// From the working directory on if it lies below that: clients of a server do not see where it is.
std::string shown(const fs::path& file) {
  std::error_code error;
  const fs::path relative = file.lexically_relative(real_path(fs::current_path(error)));
  const bool is_below = !relative.empty() && *relative.begin() != "..";
  return "'" + algebra3d::shown_as_text((is_below ? relative : file).string()) + "'";
}

std::string named(const std::set<std::string>& names) {
  std::vector<std::string> first(names.begin(), std::next(names.begin(), std::min(names.size(), kMostNamed)));
  if (names.size() > first.size()) first.push_back(fmt::format("and {} more", names.size() - first.size()));
  return fmt::format("{}", fmt::join(first, ", "));
}

std::string joined(const std::vector<std::string>& clauses) {
  return fmt::format("{}", fmt::join(clauses, "; "));
}

}  // namespace

RestoreGuard::RestoreGuard(const SavedText& saved, bool allows_all)
    : saved_(saved), allows_all_(allows_all), folder_(real_path(saved.folder())) {
  if (!allows_all) refused_variables_ = saved.variables();
}

Status RestoreGuard::check(const fs::path& file) {
  if (allows_all_) return {};
  const fs::path real = real_path(file);
  if (is_visible_below(folder_, real)) return {};
  const std::string name = shown(real.empty() ? file : real);
  const std::lock_guard lock(mutex_);
  ++refusal_count_;
  refused_files_.insert(name);
  return Error{ErrorCode::permission_denied, "{} lies outside of the folder of the saved file", name};
}

std::size_t RestoreGuard::refusal_count() const {
  const std::lock_guard lock(mutex_);
  return refusal_count_;
}

Status RestoreGuard::verdict(bool is_shared, algebra3d::Context& context) const {
  if (!has_refused()) return {};
  const std::set<std::string> variables(refused_variables_.begin(), refused_variables_.end());
  std::vector<std::string> clauses;
  if (!refused_files_.empty()) clauses.push_back(fmt::format("files outside of its folder: {}", named(refused_files_)));
  if (!variables.empty()) clauses.push_back("environment variables: " + named(variables));
  if (!untried_.empty())
    clauses.push_back("and what these objects read, which need the others and were not tried: " + named(untried_));
  for (const std::string& file : refused_files_)
    context.diagnostics.show(context.folder.with_names("restore: the saved file would read the file " + file));
  for (const std::string& variable : variables)
    context.diagnostics.show("restore: the saved file would read the environment variable " + variable);
  return Error{ErrorCode::wrong_usage, "restore: nothing was restored, since '{}' would read {}; {}",
               algebra3d::shown_as_text(saved_.name()), context.folder.with_names(joined(clauses)),
               is_shared ? "a shared database takes no such file; restore it in the shell"
                         : "if it may, set \"restoreReads\" = TRUE and restore it again"};
}

}  // namespace queries
