#include "queries/store/detail/database.h"

#include "algebra3d/values/types/codec.h"
#include "base/propagate.h"
#include "queries/store/detail/chunks.h"

namespace queries {

Result<std::shared_ptr<Database>> Database::open(const std::filesystem::path& file, OpenMode mode,
                                                 const algebra3d::Registry& registry, const StoreOptions& options) {
  A3D_ASSIGN(auto connection, open_database_file(file, mode, options));
  std::shared_ptr<Database> database(new Database(std::move(connection), file, registry, options));
  // A damaged catalogue is found now, not in the middle of somebody's work.
  Status status = database->upgrade();
  if (status) status = database->begin(false);
  if (status) status = database->commit();
  // From here on nobody deletes it: its lock is held.
  if (database->connection_->has_moved()) return deleted_meanwhile(file);
  if (!status) return std::move(status).error();
  return database;
}

Result<std::shared_ptr<Database>> Database::open_damaged(const std::filesystem::path& file,
                                                         const algebra3d::Registry& registry) {
  const StoreOptions options;
  A3D_ASSIGN(auto connection, open_database_file(file, OpenMode::read_damaged, options));
  std::shared_ptr<Database> database(new Database(std::move(connection), file, registry, options));
  database->is_read_only_ = true;
  database->catalogue_.tolerate_damage();
  return database;
}

Database::Database(std::unique_ptr<SqliteConnection> connection, std::filesystem::path file,
                   const algebra3d::Registry& registry, const StoreOptions& options)
    : file_(std::move(file)),
      registry_(registry),
      options_(options),
      connection_(std::move(connection)),
      access_(connection_->access()),
      is_read_only_(connection_->is_read_only()),
      catalogue_(*connection_),
      row_groups_(*connection_, catalogue_),
      cache_(options.cache_bytes) {}

Database::~Database() = default;

Result<std::unique_ptr<SqliteConnection>> Database::another_connection(bool writes, int busy_milliseconds) const {
  using Access = SqliteConnection::Access;
  const bool is_for_reading = access_ != Access::read_write && access_ != Access::create;
  return SqliteConnection::open(file_,
                                is_for_reading ? access_
                                : writes       ? Access::read_write
                                               : Access::read_only,
                                busy_milliseconds);
}

Result<std::shared_ptr<const RelationLayout>> Database::layout_of(const CatalogueEntry& relation) {
  const auto known = layouts_.find(relation.table_number);
  if (known != layouts_.end()) return known->second;
  A3D_ASSIGN(auto layout,
             RelationLayout::make(registry_, relation.type.element(), relation.name, relation.table_number));
  layouts_.emplace(relation.table_number, layout);
  return layout;
}

// Pages of older files have no checksums, and no room for them.
bool Database::makes_row_groups(const RelationLayout& layout) const {
  return layout.has_columns() && options_.group_rows > 0 && catalogue_.version() > kLastVersionWithoutPageSums;
}

Result<const std::vector<std::size_t>*> Database::key_attributes(const RelationLayout& layout) {
  const auto known = key_attributes_.find(layout.table_number());
  if (known != key_attributes_.end()) return &known->second;
  std::vector<std::size_t> attributes;
  if (layout.has_columns() && has_row_groups()) {
    A3D_ASSIGN(SqliteStatement rows,
               connection_->use("SELECT name FROM sqlite_schema WHERE type = 'table' AND name GLOB ?"));
    const std::string pattern = fmt::format("keys_{}_*", layout.table_number());
    rows.bind(1, std::string_view(pattern));
    while (true) {
      A3D_ASSIGN(const bool has_row, rows.step());
      if (!has_row) break;
      for (std::size_t attribute = 0; attribute < layout.attributes().size(); ++attribute)
        if (layout.keys_table(attribute) == rows.column(0).bytes) attributes.push_back(attribute);
    }
  }
  return &key_attributes_.emplace(layout.table_number(), std::move(attributes)).first->second;
}

Result<Database::LooseRows> Database::loose_rows(const RelationLayout& layout) {
  const auto known = loose_rows_.find(layout.table_number());
  if (known != loose_rows_.end()) return known->second;
  A3D_ASSIGN(const GroupListPtr groups, row_groups_.list(layout));
  LooseRows rows;
  const TupleId first = groups->is_empty() ? 0 : (*groups)[0].content->first;
  const auto count = [&](const std::string& condition) {
    return connection_->integer(fmt::format("SELECT count(*) FROM (SELECT 1 FROM {} WHERE {} LIMIT {})", layout.table(),
                                            condition, 1 + 2 * options_.loose_rows));
  };
  A3D_ASSIGN(rows.outside, count(fmt::format("id < {} OR id > {}", first, groups->last())));
  if (!groups->is_empty()) {
    A3D_ASSIGN(rows.within, connection_->integer(fmt::format("SELECT count(*) FROM {} WHERE id BETWEEN {} AND {}",
                                                             layout.table(), first, groups->last())));
  }
  loose_rows_.emplace(layout.table_number(), rows);
  return rows;
}

void Database::note_loose(std::int64_t table_number, LooseRows change) {
  std::int64_t& count = loosened_[table_number];
  count += std::max<std::int64_t>(change.outside, 0) + std::max<std::int64_t>(change.within, 0);
  const auto known = loose_rows_.find(table_number);
  if (known == loose_rows_.end()) return;
  known->second.outside += change.outside;
  known->second.within += change.within;
}

// Until now the row can be read through one connection or the other.
Status Database::note_tuple(const RelationLayout& layout, TupleId tuple) {
  const std::lock_guard lock(mutex_);
  if (is_outdated(layout, tuple) && changes_.is_untouched(layout.table_number(), tuple))
    A3D_TRY(kept_.keep(*connection_, layout, tuple));
  changes_.note_tuple(layout.table_number(), tuple);
  cache_.erase(layout.table_number(), tuple);
  return {};
}

void Database::note_group_tuples(std::int64_t table_number, std::span<const TupleId> tuples) {
  const std::lock_guard lock(mutex_);
  changes_.note_tuples(table_number, tuples);
}

// The other connection sees what was there before the transaction, and not what its statements have made of it.
bool Database::is_outdated(const RelationLayout& layout, TupleId tuple) const {
  return is_explicit_ && !earlier_.is_original(layout.table_number(), tuple);
}

void Database::note_created(std::int64_t table_number) {
  const std::lock_guard lock(mutex_);
  changes_.note_created(table_number);
}

void Database::drop_at_end(const std::shared_ptr<const RelationLayout>& layout) {
  const std::lock_guard lock(mutex_);
  dropped_.push_back(layout);
  changes_.note_dropped(layout->table_number());
  cache_.erase_table(layout->table_number());
  indexes_.drop_table(layout->table_number());
  row_groups_.forget(layout->table_number());
  key_attributes_.erase(layout->table_number());
  loose_rows_.erase(layout->table_number());
  loosened_.erase(layout->table_number());
  layouts_.erase(layout->table_number());
}

void Database::note_renamed(std::int64_t table_number) {
  const std::lock_guard lock(mutex_);
  changes_.note_renamed(table_number);
  layouts_.erase(table_number);
}

Error Database::lost(const RelationLayout& layout, TupleId tuple) {
  return Error{ErrorCode::wrong_usage,
               "tuple {} was made and changed again by the statement that still reads it; use two statements", tuple}
      .about(layout.relation());
}

Error Database::missing(const RelationLayout& layout, TupleId tuple) {
  return Error{ErrorCode::database_corrupt, "the row of tuple {} is not where it was written", tuple}.about(
      layout.relation());
}

Result<SqliteConnection*> Database::source_of(const RelationLayout& layout, TupleId tuple, ChangeTime time) {
  switch (changes_.where(layout.table_number(), tuple, time)) {
    case ChangeLog::Whereabouts::current:
      return connection_.get();
    case ChangeLog::Whereabouts::original:
      if (is_outdated(layout, tuple)) return kept_.connection();
      return original();
    case ChangeLog::Whereabouts::lost:
      break;
  }
  return lost(layout, tuple);
}

// This transaction has written, so it holds the only lock for writing: nobody has committed since its beginning, and
// another connection still sees the state of that time.
Result<SqliteConnection*> Database::original() {
  if (original_ == nullptr) {
    A3D_ASSIGN(original_,
               SqliteConnection::open(file_, SqliteConnection::Access::read_only, options_.busy_milliseconds));
  }
  if (!original_->in_transaction()) A3D_TRY(original_->execute("BEGIN"));
  return original_.get();
}

Status Database::with_bytes(const LargeValue& value, const std::function<Status(std::string_view)>& visit) {
  const RelationLayout& layout = *value.layout;
  std::unique_lock lock(mutex_);
  A3D_TRY(check_statement(value.statement));
  A3D_ASSIGN(SqliteConnection * source, source_of(layout, value.tuple, value.time));
  lock.unlock();
  A3D_ASSIGN(SqliteStatement statement, source->use(layout.bytes_sql(value.attribute)));
  statement.bind(1, value.tuple);
  A3D_ASSIGN(const bool has_row, statement.step());
  if (!has_row) return missing(layout, value.tuple);
  const Cell cell = statement.column(0);
  std::string joined;
  if (cell.is(Cell::Kind::integer)) {
    const ChunkPlace place{layout.table_number(), value.tuple, static_cast<std::int64_t>(value.attribute)};
    A3D_ASSIGN(joined, read_chunks(*source, place, cell.integer));
  }
  const std::string_view bytes = joined.empty() ? cell.bytes : std::string_view(joined);
  if (checksum_of(bytes) != value.checksum)
    return Error{ErrorCode::database_corrupt, "the bytes of '{}' are not what was written",
                 layout.attributes()[value.attribute].name}
        .about(fmt::format("tuple {}", value.tuple))
        .about(layout.relation());
  return visit(bytes);
}

Result<Value> Database::decode(const LargeValue& value, std::uint64_t& byte_count) {
  const AttributeColumns& attribute = value.layout->attributes()[value.attribute];
  Value result(*attribute.type);
  A3D_TRY(with_bytes(value, [&](std::string_view bytes) -> Status {
    byte_count = bytes.size();
    A3D_ASSIGN(result, algebra3d::decode(*attribute.type, bytes, algebra3d::Origin::own_store));
    return {};
  }));
  ++geometry_loads_;
  return result;
}

Result<Value> Database::load(const LargeValue& value) {
  const ValuePlace place{value.layout->table_number(), value.tuple, value.attribute};
  {
    const std::lock_guard lock(mutex_);
    A3D_TRY(check_statement(value.statement));
    const auto where = changes_.where(place.table_number, place.tuple, value.time);
    if (where == ChangeLog::Whereabouts::current)
      if (const auto kept = cache_.find(place)) return *kept;
  }
  std::uint64_t byte_count = 0;
  A3D_ASSIGN(Value result, decode(value, byte_count));
  // In memory a triangle takes about 40 bytes, and 50 with its hierarchy; the encoded bytes stand for exact
  // coordinates.
  const std::uint64_t estimate = byte_count + std::uint64_t{96} * value.header.size + 256;
  std::vector<Value> left;  // destroyed after the lock
  const std::lock_guard lock(mutex_);
  if (changes_.where(place.table_number, place.tuple, value.time) == ChangeLog::Whereabouts::current)
    left = cache_.add(place, result, estimate);
  return result;
}

bool Database::is_in_memory(const LargeValue& value) {
  const std::lock_guard lock(mutex_);
  const auto where = changes_.where(value.layout->table_number(), value.tuple, value.time);
  return where == ChangeLog::Whereabouts::current &&
         cache_.find({value.layout->table_number(), value.tuple, value.attribute}).has_value();
}

void Database::keep_face_blocks_later(BlockedValue value) {
  // They are made before the next statement runs, and the values stay in memory until then.
  constexpr std::size_t kMostFaces = 4'000'000;
  const std::lock_guard lock(mutex_);
  std::size_t faces = value.value.header().size;
  for (const BlockedValue& waiting : values_to_block_) {
    if (waiting.place == value.place) return;
    faces += waiting.value.header().size;
  }
  if (values_to_block_.empty() || faces <= kMostFaces) values_to_block_.push_back(std::move(value));
}

std::uint64_t Database::block_faces(const LevelPlace& place, std::uint64_t checksum) const {
  const std::lock_guard lock(mutex_);
  const auto known = block_faces_.find({place, checksum});
  return known == block_faces_.end() ? 0 : known->second;
}

void Database::note_block_faces(const LevelPlace& place, std::uint64_t checksum, std::uint64_t count) {
  const std::lock_guard lock(mutex_);
  block_faces_[{place, checksum}] += count;
}

std::uint64_t Database::faces_in_blocks() const {
  const std::lock_guard lock(mutex_);
  std::uint64_t sum = 0;
  for (const auto& [place, count] : block_faces_) sum += count;
  return sum;
}

}  // namespace queries
