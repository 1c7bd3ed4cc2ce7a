#pragma once

#include <filesystem>
#include <string_view>

#include "base/draft_file.h"
#include "queries/store/store_options.h"

namespace queries {

/// The ending of the interim name of a database that is being created, before a process id and a number.
inline constexpr std::string_view kNewEnding = ".new-";
/// The ending of the interim name of a database that is being restored.
inline constexpr std::string_view kRestoreEnding = ".restore-";

/// A new database under an interim name beside its place, without objects. Its file says in its header that it is a
/// draft (kDraftApplicationId), which no finished database does, and is locked as long as this object lives; so
/// `remove_database_leftovers` knows those whose owner was killed. Removed with this object unless it was published.
/// Whoever fills it opens it with OpenMode::draft and closes it before it is published.
class DatabaseDraft {
 public:
  /// Errors, which name `file`: disk_full, io_error, file_missing.
  static Result<DatabaseDraft> create(const std::filesystem::path& file, std::string_view ending);

  DatabaseDraft(DatabaseDraft&&) noexcept = default;
  DatabaseDraft& operator=(DatabaseDraft&&) noexcept = default;
  DatabaseDraft(const DatabaseDraft&) = delete;
  DatabaseDraft& operator=(const DatabaseDraft&) = delete;
  ~DatabaseDraft();

  const std::filesystem::path& path() const { return draft_.path(); }

  /// Gives it its name, which no file may have, or with `replaces_empty` an empty one, and then takes the mark away.
  /// A process that is killed between these leaves a database that `finish_database` finishes. Errors: database_exists,
  /// disk_full, io_error.
  Status publish(bool replaces_empty);

 private:
  DatabaseDraft(std::filesystem::path file, algebra3d::DraftFile draft)
      : file_(std::move(file)), draft_(std::move(draft)) {}

  std::filesystem::path file_;
  algebra3d::DraftFile draft_;
};

/// Error if the name of a new database is so long that the files beside it would have names that no file may have.
Status check_name_length(const std::filesystem::path& file);

/// If `file` has its name and still the mark of a draft: waits for its owner to take it away or, if that one was
/// killed, does so itself. Errors: database_busy, io_error.
Status finish_database(const std::filesystem::path& file, int busy_milliseconds);

/// Removes what killed processes have left in the folder of `file` when they made or restored databases there: files
/// with an interim name, whose owner is gone, and which have the mark of a draft or are empty. A finished database
/// stays whatever its name.
void remove_database_leftovers(const std::filesystem::path& file);

}  // namespace queries
