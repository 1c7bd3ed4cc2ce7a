// The commands of a session that create, open, close and delete databases.
#include <algorithm>

#include "queries/session/database_files.h"
#include "queries/session/session.h"

namespace queries {
namespace {

// The catalogue, which says how many there are, may be wrong itself.
std::string how_far(const CheckProgress& progress) {
  constexpr std::uint64_t kAll = 100;
  return fmt::format("{} % ({})", std::min(kAll, kAll * progress.done / std::max<std::uint64_t>(progress.total, 1)),
                     progress.object);
}

}  // namespace

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

Status Session::run(const OpenDatabase& command, Presenter&, Context& context) {
  RETURN_IF_ERROR(require_closed());
  ASSIGN_OR_RETURN(const auto file, database_file(command.name));
  ASSIGN_OR_RETURN(store_,
                   Store::open(file, options_.read_only ? OpenMode::read_only : OpenMode::read_write, registry_));
  if (!store_->opening_notice().empty()) context.diagnostics.report(store_->opening_notice());
  return {};
}

Status Session::run(const CloseDatabase&, Presenter&, Context&) {
  ASSIGN_OR_RETURN(const Store* const store, required_store());
  if (store->is_in_explicit_transaction())
    return Error{ErrorCode::wrong_usage,
                 "a transaction is running; end it with `commit transaction` or `abort transaction` first"};
  store_.reset();
  return {};
}

// The file is opened first, so that nothing is removed that is no database of ours.
Status Session::run(const DeleteDatabase& command, Presenter&, Context&) {
  RETURN_IF_ERROR(require_closed());
  if (options_.read_only) return Error{ErrorCode::database_read_only, "delete database: the session is read-only"};
  ASSIGN_OR_RETURN(const auto file, database_file(command.name));
  RETURN_IF_ERROR(Store::open(file, OpenMode::read_write, registry_));
  return remove_database_files(file);
}

Status Session::run(const TransactionStep& command, Presenter&, Context&) {
  ASSIGN_OR_RETURN(Store * store, required_store());
  switch (command.step) {
    case TransactionStep::Step::begin:
      return store->begin_transaction();
    case TransactionStep::Step::commit:
      return store->commit_transaction();
    case TransactionStep::Step::abort:
      return store->abort_transaction();
  }
  return {};
}

// (inquiry (findings ((object tuple attribute 'what is wrong') ...))); a database with findings is an error.
Status Session::run(const CheckDatabase&, Presenter& presenter, Context& context) {
  ASSIGN_OR_RETURN(Store * store, required_store());
  const auto report = [&presenter](const CheckProgress& progress) { presenter.advance(how_far(progress)); };
  std::vector<Finding> findings;
  RETURN_IF_ERROR(in_transaction(false, [&]() -> Status {
    ASSIGN_OR_RETURN(findings, store->check(context, report));
    return {};
  }));
  NestedList::List rows;
  for (const Finding& finding : findings)
    rows.push_back(NestedList::list(NestedList(finding.object), NestedList(static_cast<double>(finding.tuple)),
                                    NestedList(finding.attribute), NestedList::text(finding.message)));
  const std::size_t count = rows.size();
  RETURN_IF_ERROR(presenter.present_inquiry(NestedList::list(
      NestedList::symbol("inquiry"), NestedList::list(NestedList::symbol("findings"), NestedList(std::move(rows))))));
  if (count == 0) return {};
  return Error{ErrorCode::database_corrupt, "check database: {} finding{}; they are listed above", count,
               count == 1 ? "" : "s"};
}

}  // namespace queries
