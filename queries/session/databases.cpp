// The commands of a session that create, open, close and delete databases.
#include <system_error>

#include "queries/session/session.h"

namespace queries {

Status Session::require_closed() {
  if (store_ == nullptr) return {};
  return Error{ErrorCode::database_open, "the database '{}' is open; close it first with `close database`",
               store_->file().stem().string()};
}

Result<std::filesystem::path> Session::database_file(const std::string& name) const {
  return options_.folder / (name + ".db");
}

Status Session::run(const CreateDatabase& command, Presenter&, Context&) {
  RETURN_IF_ERROR(require_closed());
  if (options_.read_only) return Error{ErrorCode::database_read_only, "create database: the session is read-only"};
  ASSIGN_OR_RETURN(const auto file, database_file(command.name));
  RETURN_IF_ERROR(Store::open(file, OpenMode::create, registry_));
  return {};
}

Status Session::run(const OpenDatabase& command, Presenter&, Context&) {
  RETURN_IF_ERROR(require_closed());
  ASSIGN_OR_RETURN(const auto file, database_file(command.name));
  ASSIGN_OR_RETURN(store_,
                   Store::open(file, options_.read_only ? OpenMode::read_only : OpenMode::read_write, registry_));
  return {};
}

Status Session::run(const CloseDatabase&, Presenter&, Context&) {
  RETURN_IF_ERROR(required_store());
  store_.reset();
  return {};
}

// The file is opened first, so that nothing is removed that is no database of ours.
Status Session::run(const DeleteDatabase& command, Presenter&, Context&) {
  RETURN_IF_ERROR(require_closed());
  if (options_.read_only) return Error{ErrorCode::database_read_only, "delete database: the session is read-only"};
  ASSIGN_OR_RETURN(const auto file, database_file(command.name));
  RETURN_IF_ERROR(Store::open(file, OpenMode::read_write, registry_));
  for (const char* suffix : {"-wal", "-shm", ""}) {
    std::error_code error;
    std::filesystem::remove(file.string() + suffix, error);
    if (error) return Error{ErrorCode::io_error, "delete database: {}{}: {}", file.string(), suffix, error.message()};
  }
  return {};
}

}  // namespace queries
