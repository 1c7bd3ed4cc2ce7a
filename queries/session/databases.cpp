// The commands of a session that create, open, close and delete databases.
#include <algorithm>

#include "base/propagate.h"
#include "queries/session/session.h"
#include "queries/store/database_creation.h"
#include "queries/store/store_options.h"

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
  if (damaged_)
    return Error{ErrorCode::database_open, "the damaged database '{}' is open; close it first with `close database`",
                 damaged_->file.stem().string()};
  if (store_ == nullptr) return {};
  return Error{ErrorCode::database_open, "the database '{}' is open; close it first with `close database`",
               store_->file().stem().string()};
}

Result<std::filesystem::path> Session::database_file(const std::string& name) const {
  return options_.folder / (name + ".db");
}

Status Session::run(const CreateDatabase& command, Presenter&, Context&) {
  A3D_TRY(require_closed());
  if (options_.read_only) return Error{ErrorCode::database_read_only, "create database: the session is read-only"};
  A3D_ASSIGN(const auto file, database_file(command.name));
  A3D_TRY(Store::open(file, OpenMode::create, registry_));
  return {};
}

Status Session::run(const OpenDatabase& command, Presenter&, Context& context) {
  A3D_TRY(require_closed());
  A3D_ASSIGN(const auto file, database_file(command.name));
  A3D_TRY(open_store(file, options_.read_only ? OpenMode::read_only : OpenMode::read_write));
  if (!store_->opening_notice().empty()) context.diagnostics.report(store_->opening_notice());
  return {};
}

Status Session::run(const CloseDatabase&, Presenter&, Context&) {
  if (damaged_) {
    damaged_.reset();
    return {};
  }
  A3D_ASSIGN(const Store* const store, required_store());
  if (store->is_in_explicit_transaction())
    return Error{ErrorCode::wrong_usage,
                 "a transaction is running; end it with `commit transaction` or `abort transaction` first"};
  store_.reset();
  return {};
}

Status Session::run(const DeleteDatabase& command, Presenter&, Context&) {
  A3D_TRY(require_closed());
  if (options_.read_only) return Error{ErrorCode::database_read_only, "delete database: the session is read-only"};
  A3D_ASSIGN(const auto file, database_file(command.name));
  return delete_database_file(file);
}

Status Session::run(const TransactionStep& command, Presenter&, Context&) {
  A3D_ASSIGN(Store * store, required_store());
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

// Nothing is written, so that the statement can end by going back; SQLite may refuse to commit after it met damage.
Result<std::vector<Finding>> Session::findings(Presenter& presenter, Context& context) {
  const auto report = [&presenter](const CheckProgress& progress) { presenter.advance(how_far(progress)); };
  if (damaged_) {
    auto found = Store::check_damaged(damaged_->file, registry_, context, report);
    // The reason why the file could not be opened is a finding, also if the check has found a way round it.
    if (found && found->empty()) found->push_back({.message = "the catalogue: " + damaged_->error.text()});
    return found;
  }
  A3D_ASSIGN(Store * store, required_store());
  A3D_TRY(store->begin(false));
  auto found = store->check(context, report);
  store->rollback();
  return found;
}

// (inquiry (findings ((object tuple attribute 'what is wrong') ...))); a database with findings is an error.
Status Session::run(const CheckDatabase&, Presenter& presenter, Context& context) {
  A3D_ASSIGN(const std::vector<Finding> found, findings(presenter, context));
  const bool is_shown = presenter.shows_inquiries();
  NestedList::List rows;
  for (const Finding& finding : found) {
    if (!is_shown) context.diagnostics.show(finding.text());
    rows.push_back(NestedList::list(NestedList(finding.object), NestedList(finding.tuple),
                                    NestedList(finding.attribute), NestedList::text(finding.message)));
  }
  const std::size_t count = rows.size();
  A3D_TRY(presenter.present_inquiry(NestedList::list(
      NestedList::symbol("inquiry"), NestedList::list(NestedList::symbol("findings"), NestedList(std::move(rows))))));
  if (count == 0) return {};
  return Error{ErrorCode::database_corrupt, "check database: {} finding{}; they are {}", count, count == 1 ? "" : "s",
               is_shown ? "listed above" : "in the notes"};
}

}  // namespace queries
