#include "queries/store/detail/stored_object_value.h"

#include "algebra3d/values/types/codec.h"
#include "base/propagate.h"
#include "queries/store/detail/stored_object.h"

namespace queries {
namespace {

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

}  // namespace

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
  if (!value) return Error{value.error().code, "{}: {}", entry_.name, value.error().message};
  loaded_ = *std::move(value);
  return *loaded_;
}

std::shared_ptr<const algebra3d::DeferredSource> StoredObjectValue::source() const {
  return std::make_shared<OneValue>(type_, shared_from_this());
}

}  // namespace queries
