#include "queries/store/database.h"

#include "algebra3d/types/codec.h"
#include "queries/store/chunks.h"
#include "queries/store/database_file.h"

namespace queries {

Result<std::shared_ptr<Database>> Database::open(const std::filesystem::path& file, OpenMode mode,
                                                 const algebra3d::Registry& registry, const StoreOptions& options) {
  ASSIGN_OR_RETURN(auto connection, open_database_file(file, mode, options));
  std::shared_ptr<Database> database(new Database(std::move(connection), file, registry, options));
  // A damaged catalogue is found now, not in the middle of somebody's work.
  RETURN_IF_ERROR(database->begin(false));
  RETURN_IF_ERROR(database->commit());
  return database;
}

Database::Database(std::unique_ptr<SqliteConnection> connection, std::filesystem::path file,
                   const algebra3d::Registry& registry, const StoreOptions& options)
    : file_(std::move(file)),
      registry_(registry),
      options_(options),
      connection_(std::move(connection)),
      is_read_only_(connection_->is_read_only()),
      catalogue_(*connection_),
      cache_(options.cache_bytes) {}

Database::~Database() = default;

void Database::close() {
  rollback();
  forget_everything();
  original_.reset();
  connection_.reset();
}

Status Database::begin(bool writes) {
  if (is_in_transaction()) return Error{ErrorCode::internal, "{}: a statement is running already", file_.string()};
  if (writes && is_read_only_)
    return Error{ErrorCode::database_read_only, "{}: the database was opened for reading only", file_.string()};
  RETURN_IF_ERROR(connection_->execute(writes ? "BEGIN IMMEDIATE" : "BEGIN"));
  ++statement_;
  Status status = notice_other_processes();
  if (status) status = catalogue_.load();
  if (!status) rollback();
  return status;
}

// The number changes exactly when another connection has committed; reading it fixes what this transaction sees.
Status Database::notice_other_processes() {
  ASSIGN_OR_RETURN(const std::int64_t version, connection_->integer("PRAGMA data_version"));
  if (version != data_version_) forget_everything();
  data_version_ = version;
  return {};
}

void Database::forget_everything() {
  const std::lock_guard lock(mutex_);
  catalogue_.forget();
  indexes_.clear();
  layouts_.clear();
  cache_.clear();
}

Status Database::commit() {
  Status status = failure_ ? Status(*failure_) : check_reading();
  if (status && has_written_) status = catalogue_.flush();
  if (status) status = connection_->execute("COMMIT");
  if (!status) {
    rollback();
    return status;
  }
  end_statement();
  return {};
}

void Database::rollback() {
  if (connection_ == nullptr) return;
  // SQLite may have rolled back by itself. If the statement fails, closing the file does the same.
  if (connection_->in_transaction()) static_cast<void>(connection_->execute("ROLLBACK"));
  if (has_written_) forget_everything();
  end_statement();
}

void Database::end_statement() {
  const std::lock_guard lock(mutex_);
  ++statement_;
  has_written_ = false;
  failure_.reset();
  changes_.clear();
  if (original_ != nullptr && original_->in_transaction() && !original_->execute("COMMIT")) original_.reset();
}

Status Database::check_statement(std::uint64_t statement) const {
  if (is_in_transaction() && statement == statement_) return {};
  return Error{ErrorCode::internal, "{}: stored data was used after the end of its statement", file_.string()};
}

Status Database::check_reading() const {
  if (is_in_transaction()) return {};
  if (failure_) return *failure_;
  return Error{ErrorCode::internal, "{}: no statement is running", file_.string()};
}

Status Database::change(const std::function<Status()>& work) {
  RETURN_IF_ERROR(check_reading());
  if (is_read_only_)
    return Error{ErrorCode::database_read_only, "{}: the database was opened for reading only", file_.string()};
  if (failure_) return *failure_;
  has_written_ = true;
  Status status = work();
  if (!status) failure_ = status.error();
  return status;
}

Result<std::shared_ptr<const RelationLayout>> Database::layout_of(const CatalogueEntry& relation) {
  const auto known = layouts_.find(relation.table_number);
  if (known != layouts_.end()) return known->second;
  ASSIGN_OR_RETURN(auto layout,
                   RelationLayout::make(registry_, relation.type.element(), relation.name, relation.table_number));
  layouts_.emplace(relation.table_number, layout);
  return layout;
}

void Database::note_tuple(const RelationLayout& layout, TupleId tuple) {
  const std::lock_guard lock(mutex_);
  changes_.note_tuple(layout.table_number(), tuple);
  cache_.erase(layout.table_number(), tuple);
}

void Database::note_created(std::int64_t table_number) {
  const std::lock_guard lock(mutex_);
  changes_.note_created(table_number);
}

void Database::note_dropped(std::int64_t table_number) {
  const std::lock_guard lock(mutex_);
  changes_.note_dropped(table_number);
  cache_.erase_table(table_number);
  indexes_.drop_table(table_number);
  layouts_.erase(table_number);
}

Error Database::lost(const RelationLayout& layout, TupleId tuple) {
  return {ErrorCode::wrong_usage,
          "{}: tuple {} was made and changed again by the statement that still reads it; use two statements",
          layout.relation(), tuple};
}

Result<SqliteConnection*> Database::source_of(const RelationLayout& layout, TupleId tuple, ChangeTime time) {
  switch (changes_.where(layout.table_number(), tuple, time)) {
    case ChangeLog::Whereabouts::current:
      return connection_.get();
    case ChangeLog::Whereabouts::original:
      return original();
    case ChangeLog::Whereabouts::lost:
      break;
  }
  return lost(layout, tuple);
}

// This statement has written, so it holds the only lock for writing: nobody has committed since its beginning, and what
// another connection sees now is what was there then.
Result<SqliteConnection*> Database::original() {
  if (original_ == nullptr) {
    ASSIGN_OR_RETURN(original_,
                     SqliteConnection::open(file_, SqliteConnection::Access::read_only, options_.busy_milliseconds));
  }
  if (!original_->in_transaction()) RETURN_IF_ERROR(original_->execute("BEGIN"));
  return original_.get();
}

Status Database::with_bytes(const LargeValue& value, const std::function<Status(std::string_view)>& visit) {
  const RelationLayout& layout = *value.layout;
  std::unique_lock lock(mutex_);
  RETURN_IF_ERROR(check_statement(value.statement));
  ASSIGN_OR_RETURN(SqliteConnection * source, source_of(layout, value.tuple, value.time));
  lock.unlock();
  ASSIGN_OR_RETURN(SqliteStatement statement, source->use(layout.bytes_sql(value.attribute)));
  statement.bind(1, value.tuple);
  ASSIGN_OR_RETURN(const bool has_row, statement.step());
  if (!has_row) return lost(layout, value.tuple);
  const Cell cell = statement.column(0);
  std::string joined;
  if (cell.is(Cell::Kind::integer)) {
    const ChunkPlace place{layout.table_number(), value.tuple, static_cast<std::int64_t>(value.attribute)};
    ASSIGN_OR_RETURN(joined, read_chunks(*source, place, cell.integer));
  }
  const std::string_view bytes = joined.empty() ? cell.bytes : std::string_view(joined);
  if (checksum_of(bytes) != value.checksum)
    return Error{ErrorCode::database_corrupt, "{}: tuple {}: the bytes of '{}' are not what was written",
                 layout.relation(), value.tuple, layout.attributes()[value.attribute].name};
  return visit(bytes);
}

Result<Value> Database::decode(const LargeValue& value, std::uint64_t& byte_count) {
  const AttributeColumns& attribute = value.layout->attributes()[value.attribute];
  Value result(*attribute.type);
  RETURN_IF_ERROR(with_bytes(value, [&](std::string_view bytes) -> Status {
    byte_count = bytes.size();
    ASSIGN_OR_RETURN(result, algebra3d::decode(*attribute.type, bytes, algebra3d::Origin::own_store));
    return {};
  }));
  ++geometry_loads_;
  return result;
}

Result<Value> Database::load(const LargeValue& value) {
  const ValuePlace place{value.layout->table_number(), value.tuple, value.attribute};
  {
    const std::lock_guard lock(mutex_);
    RETURN_IF_ERROR(check_statement(value.statement));
    const auto where = changes_.where(place.table_number, place.tuple, value.time);
    if (where == ChangeLog::Whereabouts::current)
      if (const auto kept = cache_.find(place)) return *kept;
  }
  std::uint64_t byte_count = 0;
  ASSIGN_OR_RETURN(Value result, decode(value, byte_count));
  // In memory a triangle takes about 40 bytes, a point 24; the encoded bytes stand for exact coordinates.
  const std::uint64_t estimate = byte_count + std::uint64_t{64} * value.header.size + 256;
  const std::lock_guard lock(mutex_);
  if (changes_.where(place.table_number, place.tuple, value.time) == ChangeLog::Whereabouts::current)
    cache_.add(place, result, estimate);
  return result;
}

}  // namespace queries
