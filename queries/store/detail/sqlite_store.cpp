#include "queries/store/detail/sqlite_store.h"

#include <mutex>
#include <optional>
#include <string>

#include "algebra3d/values/types/codec.h"
#include "base/propagate.h"
#include "queries/store/detail/frozen_order.h"
#include "queries/store/detail/integrity_check.h"
#include "queries/store/detail/pulled_tables.h"
#include "queries/store/detail/read_scope.h"
#include "queries/store/detail/stored_object.h"
#include "queries/store/detail/stored_relation.h"
#include "queries/store/detail/stored_value.h"

namespace queries {
namespace {

/// The large value of an object that is not a relation, read when its geometry is first needed, and kept from then on
/// as long as this value.
class StoredObjectValue final : public StoredBytes, public std::enable_shared_from_this<StoredObjectValue> {
 public:
  /// Fewer stored bytes are read at once.
  static constexpr std::int64_t kLeastBytes = std::int64_t{1} << 18;

  /// The value of an object; nothing if it is not large. Errors: database_corrupt.
  static Result<std::optional<Value>> find(const std::shared_ptr<Database>& database, const CatalogueEntry& entry,
                                           const algebra3d::Type& type);

  StoredObjectValue(std::shared_ptr<Database> database, CatalogueEntry entry, const algebra3d::Type& type,
                    const algebra3d::GeometryHeader& header)
      : database_(std::move(database)),
        entry_(std::move(entry)),
        type_(type),
        header_(header),
        statement_(database_->statement()) {}

  algebra3d::GeometryHeader header() const override { return header_; }
  Result<Value> load() const override;
  Result<std::shared_ptr<const algebra3d::FaceBlocks>> face_blocks() const override;
  std::shared_ptr<const algebra3d::DeferredSource> source() const override;
  void append_reference(std::string& bytes) const override { bytes.push_back('\0'); }

  const Database* database() const override { return database_.get(); }
  std::uint64_t checksum() const override { return entry_.value_sum; }
  LevelPlace level_place() const override { return {0, entry_.id, 0}; }
  std::string presence_sql() const override { return "SELECT 1 FROM catalogue WHERE id = ? AND value_sum = ?"; }

 private:
  std::shared_ptr<Database> database_;
  CatalogueEntry entry_;
  const algebra3d::Type& type_;
  algebra3d::GeometryHeader header_;
  std::uint64_t statement_;
  mutable std::mutex mutex_;
  mutable std::optional<Value> loaded_;
};

/// The only value that this source has.
class OneValue final : public algebra3d::DeferredSource {
 public:
  OneValue(const algebra3d::Type& type, std::shared_ptr<const StoredObjectValue> value)
      : type_(type), value_(std::move(value)) {}

  bool is_same_as(const DeferredSource& other) const override {
    const auto* const one = dynamic_cast<const OneValue*>(&other);
    return one != nullptr && one->value_ == value_;
  }
  Value value(std::string_view /*reference*/) const override { return {type_, value_}; }

 private:
  const algebra3d::Type& type_;
  std::shared_ptr<const StoredObjectValue> value_;
};

/// Number of stored bytes, and the first of them.
struct Beginning {
  std::int64_t size = 0;
  std::string bytes;
};

Result<Beginning> beginning_of(SqliteConnection& connection, std::int64_t object) {
  static_assert(algebra3d::kCodecHeaderBytes == 96);
  A3D_ASSIGN(
      SqliteStatement statement,
      connection.use("SELECT iif(typeof(value) = 'integer', value, length(value)), typeof(value) = 'integer' FROM "
                     "object_values WHERE id = ?"));
  statement.bind(1, object);
  A3D_ASSIGN(const bool has_row, statement.step());
  if (!has_row || !statement.column(0).is(Cell::Kind::integer)) return Beginning();
  Beginning beginning{statement.column(0).integer, {}};
  if (beginning.size < StoredObjectValue::kLeastBytes) return beginning;
  A3D_ASSIGN(
      SqliteStatement first,
      connection.use(
          statement.column(1).integer != 0
              ? "SELECT substr(bytes, 1, 96) FROM chunks WHERE owner = 0 AND tuple = ? AND attribute = 0 AND part = 0"
              : "SELECT substr(value, 1, 96) FROM object_values WHERE id = ?"));
  first.bind(1, object);
  A3D_ASSIGN(const bool is_there, first.step());
  if (is_there) beginning.bytes = first.column(0).bytes;
  return beginning;
}

Result<std::optional<Value>> StoredObjectValue::find(const std::shared_ptr<Database>& database,
                                                     const CatalogueEntry& entry, const algebra3d::Type& type) {
  if (!type.is_large()) return std::optional<Value>();
  A3D_ASSIGN(const Beginning beginning, beginning_of(database->connection(), entry.id));
  if (beginning.size < kLeastBytes) return std::optional<Value>();
  A3D_ASSIGN(const auto header, algebra3d::decode_header(beginning.bytes));
  return std::optional(Value(type, std::make_shared<StoredObjectValue>(database, entry, type, header)));
}

Result<Value> StoredObjectValue::load() const {
  const std::lock_guard lock(mutex_);
  if (loaded_) return *loaded_;
  A3D_TRY(database_->check_statement(statement_));
  A3D_ASSIGN(const std::string bytes, read_object_bytes(*database_, entry_));
  auto value = algebra3d::decode(type_, bytes, algebra3d::Origin::own_store);
  if (!value) return std::move(value).error().about(entry_.name);
  loaded_ = *std::move(value);
  return *loaded_;
}

Result<std::shared_ptr<const algebra3d::FaceBlocks>> StoredObjectValue::face_blocks() const {
  using FoundBlocks = std::shared_ptr<const algebra3d::FaceBlocks>;
  A3D_TRY(database_->check_statement(statement_));
  if (!may_have_face_blocks(type_, header_.size)) return FoundBlocks();
  {
    const std::lock_guard lock(mutex_);
    if (loaded_) return FoundBlocks();
  }
  return found_face_blocks(database_);
}

std::shared_ptr<const algebra3d::DeferredSource> StoredObjectValue::source() const {
  return std::make_shared<OneValue>(type_, shared_from_this());
}

ObjectInfo info_of(const CatalogueEntry& entry) {
  return {entry.name,         entry.type,           entry.has_value,      entry.function_text,
          entry.derived_text, entry.index_relation, entry.index_attribute};
}

}  // namespace

Result<std::unique_ptr<Store>> open_store(const std::filesystem::path& file, OpenMode mode,
                                          const algebra3d::Registry& registry, const StoreOptions& options) {
  A3D_ASSIGN(auto database, Database::open(file, mode, registry, options));
  return std::unique_ptr<Store>(std::make_unique<SqliteStore>(std::move(database)));
}

Result<std::unique_ptr<Store>> Store::open(const std::filesystem::path& file, OpenMode mode,
                                           const algebra3d::Registry& registry) {
  return open_store(file, mode, registry, {});
}

Result<std::vector<ObjectInfo>> SqliteStore::objects() {
  const ReadScope scope(*database_);
  A3D_TRY(scope.status());
  std::vector<ObjectInfo> result;
  for (const auto& [name, entry] : database_->catalogue().entries()) result.push_back(info_of(entry));
  return result;
}

Result<std::optional<ObjectInfo>> SqliteStore::find(const std::string& name) {
  const ReadScope scope(*database_);
  A3D_TRY(scope.status());
  const CatalogueEntry* const entry = database_->catalogue().find(name);
  return entry != nullptr ? std::optional(info_of(*entry)) : std::nullopt;
}

Result<const CatalogueEntry*> SqliteStore::required(const std::string& name) {
  A3D_TRY(database_->check_reading());
  const CatalogueEntry* const entry = database_->catalogue().find(name);
  if (entry != nullptr) return entry;
  return Error{ErrorCode::unknown_name, "there is no object '{}'", name};
}

Status SqliteStore::check_storable(const std::string& name, const TypeExpr& type) const {
  if (type.is_relation()) {
    A3D_TRY(RelationLayout::make(database_->registry(), type.element(), name, 0));
    return {};
  }
  if (is_index(type)) return {};
  if (database_->registry().value_type(type) != nullptr) return {};
  return Error{ErrorCode::type_error, "a value of type {} cannot be stored", type.text()}.about(name);
}

Status SqliteStore::add(CatalogueEntry entry) {
  return database_->change([&]() -> Status {
    Catalogue& catalogue = database_->catalogue();
    entry.id = catalogue.take_number();
    catalogue.add(std::move(entry));
    return {};
  });
}

Status SqliteStore::check_free(const std::string& name) const {
  if (database_->catalogue().find(name) == nullptr) return {};
  return Error{ErrorCode::name_exists, "there is an object '{}' already", name};
}

Status SqliteStore::create(const std::string& name, const TypeExpr& type) {
  return create_derived(name, type, {});
}

Status SqliteStore::create_derived(const std::string& name, const TypeExpr& type, const std::string& text) {
  A3D_TRY(database_->check_reading());
  A3D_TRY(check_free(name));
  A3D_TRY(check_storable(name, type));
  CatalogueEntry entry;
  entry.name = name;
  entry.type = type;
  entry.derived_text = text;
  return add(std::move(entry));
}

Status SqliteStore::create_function(const std::string& name, const TypeExpr& type, const std::string& text) {
  A3D_TRY(database_->check_reading());
  A3D_TRY(check_free(name));
  CatalogueEntry entry;
  entry.name = name;
  entry.type = type;
  entry.has_value = true;
  entry.function_text = text;
  return add(std::move(entry));
}

Result<Datum> SqliteStore::read(const std::string& name) {
  A3D_ASSIGN(const CatalogueEntry* entry, required(name));
  if (entry->type.is_function())
    return Error{ErrorCode::wrong_usage, "'{}' is a function; it has a text, not a value", name};
  if (!entry->has_value)
    return Error{ErrorCode::not_evaluable, "the object '{}' has no value yet; give it one with update", name};
  if (entry->type.is_relation()) return read_relation(*entry);
  if (entry->type.is("rtree3")) return read_index(*entry);
  if (entry->type.is("btree")) return read_ordered_index(*entry);
  const algebra3d::Type* const type = database_->registry().value_type(entry->type);
  if (type == nullptr)
    return Error{ErrorCode::database_corrupt, "the type {} is not known", entry->type.text()}.about(name);
  auto large = StoredObjectValue::find(database_, *entry, *type);
  if (!large) return std::move(large).error().about(name);
  if (*large) return Datum{**std::move(large)};
  A3D_ASSIGN(const std::string bytes, read_object_bytes(*database_, *entry));
  auto value = algebra3d::decode(*type, bytes, algebra3d::Origin::own_store);
  if (!value) return std::move(value).error().about(name);
  return Datum{*std::move(value)};
}

Result<Datum> SqliteStore::read_relation(const CatalogueEntry& entry) {
  A3D_ASSIGN(auto layout, database_->layout_of(entry));
  return Datum{RelationPtr(std::make_shared<StoredRelation>(database_, std::move(layout)))};
}

Status SqliteStore::assign(const std::string& name, const Datum& value, const algebra3d::Context& context) {
  A3D_TRY(required(name));
  return database_->change([&]() -> Status {
    CatalogueEntry& entry = *database_->catalogue().edit(name);
    if (entry.type.is_relation()) return assign_relation(entry, value, context);
    if (const auto* index = std::get_if<std::shared_ptr<SpatialIndex>>(&value.content))
      return assign_index(entry, **index);
    if (const auto* index = std::get_if<std::shared_ptr<OrderedIndex>>(&value.content))
      return assign_index(entry, **index);
    if (const auto* plain = std::get_if<Value>(&value.content)) return assign_value(entry, *plain);
    return Error{ErrorCode::internal, "no value of type {}", entry.type.text()}.about(name);
  });
}

Status SqliteStore::assign_value(CatalogueEntry& entry, const Value& value) {
  if (&value.type() != database_->registry().value_type(entry.type))
    return Error{ErrorCode::internal, "a value of type {}, expected {}", value.type().term().text(), entry.type.text()}
        .about(entry.name);
  A3D_ASSIGN(const Value loaded, value.loaded());
  A3D_ASSIGN(const std::string bytes, algebra3d::encode_to_store(loaded));
  return write_object_bytes(*database_, entry, bytes);
}

Result<std::vector<Finding>> SqliteStore::check(const algebra3d::Context& context,
                                                const std::function<void(const CheckProgress&)>& progress) {
  return IntegrityCheck(database_, context, progress).run();
}

Result<std::vector<Finding>> Store::check_damaged(const std::filesystem::path& file,
                                                  const algebra3d::Registry& registry,
                                                  const algebra3d::Context& context,
                                                  const std::function<void(const CheckProgress&)>& progress) {
  const std::string lost = lost_bytes(file);
  const auto opened = Database::open_damaged(file, registry);
  const Status begun = opened ? (*opened)->begin(false) : Status(opened.error());
  if (!begun && begun.error().code == ErrorCode::database_corrupt)
    return std::vector<Finding>{{.message = kCatalogueFinding + begun.error().text() + (lost.empty() ? "" : "; ") +
                                            lost + "; no object can be found"}};
  A3D_TRY(begun);
  const auto& database = *opened;
  auto findings = IntegrityCheck(database, context, progress).run();
  database->close();
  if (findings && !findings->empty() && !lost.empty()) findings->insert(findings->begin(), {.message = lost});
  return findings;
}

Result<bool> SqliteStore::is_imported(const std::string& relation, const ImportedFile& file) {
  const ReadScope scope(*database_);
  A3D_TRY(scope.status());
  A3D_ASSIGN(const CatalogueEntry* entry, required(relation));
  A3D_ASSIGN(SqliteStatement statement,
             database_->connection().use("SELECT 1 FROM imported_files WHERE relation = ? AND path = ? AND size "
                                         "= ? AND hash = ?"));
  statement.bind(1, entry->id).bind(2, file.path).bind(3, as_signed(file.size)).bind(4, as_signed(file.hash));
  return statement.step();
}

Status SqliteStore::remember_imported(const std::string& relation, const ImportedFile& file) {
  A3D_ASSIGN(const CatalogueEntry* entry, required(relation));
  return database_->change([&]() -> Status {
    A3D_ASSIGN(SqliteStatement statement,
               database_->connection().use("INSERT OR REPLACE INTO imported_files VALUES(?, ?, ?, ?)"));
    statement.bind(1, entry->id).bind(2, file.path).bind(3, as_signed(file.size)).bind(4, as_signed(file.hash));
    return statement.run();
  });
}

Status SqliteStore::forget_imported(const std::string& relation, const std::string& path) {
  A3D_ASSIGN(const CatalogueEntry* entry, required(relation));
  return database_->change([&]() -> Status {
    A3D_ASSIGN(SqliteStatement statement,
               database_->connection().use("DELETE FROM imported_files WHERE relation = ? AND path = ?"));
    statement.bind(1, entry->id).bind(2, path);
    return statement.run();
  });
}

Result<std::vector<Store::PulledTable>> SqliteStore::pulled_tables(const std::string& relation) {
  const ReadScope scope(*database_);
  A3D_TRY(scope.status());
  A3D_ASSIGN(const CatalogueEntry* entry, required(relation));
  return read_pulled_tables(database_->connection(), entry->id);
}

Status SqliteStore::remember_pulled(const std::string& relation, const PulledTable& table) {
  A3D_ASSIGN(const CatalogueEntry* entry, required(relation));
  return database_->change([&] { return write_pulled_table(database_->connection(), entry->id, table); });
}

Status SqliteStore::forget_pulled(const std::string& relation) {
  A3D_ASSIGN(const CatalogueEntry* entry, required(relation));
  return database_->change([&] { return erase_pulled_tables(database_->connection(), entry->id); });
}

}  // namespace queries
