#include "algebra3d/database/database.h"

#include <utility>

#include "base/propagate.h"
#include "base/temporary_folder.h"
#include "base/without_exceptions.h"
#include "queries/database/detail/engine.h"

namespace algebra3d::database {
namespace {

Error moved_from() {
  return {ErrorCode::wrong_usage, "the database was moved elsewhere"};
}

}  // namespace

Database::Database(std::shared_ptr<detail::Engine> engine) : engine_(std::move(engine)) {}
Database::~Database() = default;
Database::Database(Database&& other) noexcept = default;
Database& Database::operator=(Database&& other) noexcept = default;

Result<Database> Database::open(const std::filesystem::path& file, const OpenOptions& options) {
  return without_exceptions([&]() -> Result<Database> {
    A3D_ASSIGN(auto engine, detail::Engine::open(file, options, {}));
    return Database(std::move(engine));
  });
}

Result<Database> Database::temporary(const OpenOptions& options) {
  return without_exceptions([&]() -> Result<Database> {
    A3D_ASSIGN(TemporaryFolder folder, TemporaryFolder::make());
    const std::filesystem::path file = folder.path() / "temporary.db";
    OpenOptions writing = options;
    writing.read_only = false;
    writing.creates = true;
    A3D_ASSIGN(auto engine, detail::Engine::open(file, writing, std::move(folder)));
    return Database(std::move(engine));
  });
}

Result<Rows> Database::query(std::string_view statement, const Parameters& parameters) {
  return without_exceptions([&]() -> Result<Rows> {
    if (engine_ == nullptr) return moved_from();
    A3D_ASSIGN(auto handover, engine_->start(statement, parameters, detail::Engine::Results::rows));
    Rows rows(engine_, std::move(handover));
    A3D_TRY(rows.wait_for_columns());
    return rows;
  });
}

Result<Value> Database::value(std::string_view statement, const Parameters& parameters) {
  return without_exceptions([&]() -> Result<Value> {
    if (engine_ == nullptr) return moved_from();
    A3D_ASSIGN(auto handover, engine_->start(statement, parameters, detail::Engine::Results::single_value));
    Rows rows(engine_, std::move(handover));
    A3D_ASSIGN(const std::vector<Row> all, rows.all());  // one row with one value, or an error
    return all.front()[0];
  });
}

Status Database::execute(std::string_view script, const Parameters& parameters) {
  return without_exceptions([&]() -> Status {
    if (engine_ == nullptr) return moved_from();
    A3D_ASSIGN(auto handover, engine_->start(script, parameters, detail::Engine::Results::dropped));
    Rows rows(engine_, std::move(handover));
    return rows.wait_for_columns();  // that is, until the end: there are none
  });
}

const Report& Database::report() const {
  static const Report none;
  return engine_ != nullptr ? engine_->report() : none;
}

void Database::on_progress(Progress progress) {
  if (engine_ != nullptr) engine_->set_progress(std::move(progress));
}

void Database::cancel() const noexcept {
  if (engine_ != nullptr) engine_->cancel();
}

bool Database::is_in_transaction() const {
  return engine_ != nullptr && engine_->is_in_transaction();
}

const std::filesystem::path& Database::file() const {
  static const std::filesystem::path none;
  return engine_ != nullptr ? engine_->file() : none;
}

const std::string& Database::opening_notice() const {
  static const std::string none;
  return engine_ != nullptr ? engine_->opening_notice() : none;
}

}  // namespace algebra3d::database
