#include "queries/store/detail/sqlite_store.h"

#include "algebra3d/values/types/codec.h"
#include "base/propagate.h"
#include "queries/store/detail/frozen_order.h"
#include "queries/store/detail/integrity_check.h"
#include "queries/store/detail/read_scope.h"
#include "queries/store/detail/stored_object.h"
#include "queries/store/detail/stored_object_value.h"
#include "queries/store/detail/stored_relation.h"

namespace queries {
namespace {

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
  return Error{ErrorCode::type_error, "{}: a value of type {} cannot be stored", name, type.text()};
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
    return Error{ErrorCode::database_corrupt, "{}: the type {} is not known", name, entry->type.text()};
  auto large = StoredObjectValue::find(database_, *entry, *type);
  if (!large) return Error{large.error().code, "{}: {}", name, large.error().message};
  if (*large) return Datum{**std::move(large)};
  A3D_ASSIGN(const std::string bytes, read_object_bytes(*database_, *entry));
  auto value = algebra3d::decode(*type, bytes, algebra3d::Origin::own_store);
  if (!value) return Error{value.error().code, "{}: {}", name, value.error().message};
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
    return Error{ErrorCode::internal, "{}: no value of type {}", name, entry.type.text()};
  });
}

Status SqliteStore::assign_value(CatalogueEntry& entry, const Value& value) {
  if (&value.type() != database_->registry().value_type(entry.type))
    return Error{ErrorCode::internal, "{}: a value of type {}, expected {}", entry.name, value.type().term().text(),
                 entry.type.text()};
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
    return std::vector<Finding>{{.message = kCatalogueFinding + begun.error().message + (lost.empty() ? "" : "; ") +
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

}  // namespace queries
