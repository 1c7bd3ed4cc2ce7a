#include "queries/store/detail/stored_value.h"

#include <cstring>
#include <type_traits>

#include "base/propagate.h"

namespace queries {
namespace {

/// The identity of a large value within its relation; a reference is its bytes.
struct Reference {
  TupleId tuple = 0;
  std::size_t attribute = 0;
  algebra3d::GeometryHeader header;
  std::uint64_t checksum = 0;
  ChangeTime time = 0;
};
static_assert(std::is_trivially_copyable_v<Reference>);

/// The large values of a relation that one statement has met.
class StoredValues final : public algebra3d::DeferredSource {
 public:
  StoredValues(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout,
               std::uint64_t statement)
      : database_(std::move(database)), layout_(std::move(layout)), statement_(statement) {}

  bool is_same_as(const DeferredSource& other) const override {
    const auto* const values = dynamic_cast<const StoredValues*>(&other);
    return values != nullptr && values->database_ == database_ && values->layout_ == layout_ &&
           values->statement_ == statement_;
  }
  Value value(std::string_view reference) const override {
    Reference own;
    assert(reference.size() == sizeof own);
    std::memcpy(&own, reference.data(), sizeof own);
    const algebra3d::Type& type = *layout_->attributes()[own.attribute].type;
    const LargeValue large{layout_, own.tuple, own.attribute, own.header, own.checksum, statement_, own.time};
    return {type, std::make_shared<StoredValue>(database_, large)};
  }

 private:
  std::shared_ptr<Database> database_;
  std::shared_ptr<const RelationLayout> layout_;
  std::uint64_t statement_;
};

}  // namespace

Result<std::shared_ptr<const algebra3d::FaceBlocks>> StoredBytes::found_face_blocks(
    const std::shared_ptr<Database>& database) const {
  A3D_ASSIGN(auto found, find_face_blocks(database, level_place(), checksum(), header()));
  if (found != nullptr || database->is_read_only() || database->is_in_explicit_transaction()) return found;
  if (database->block_faces(level_place(), checksum()) > 0) return found;  // it has some
  A3D_ASSIGN(Value value, load());
  database->keep_face_blocks_later({level_place(), checksum(), presence_sql(), std::move(value)});
  return found;
}

Result<std::shared_ptr<const algebra3d::FaceBlocks>> StoredValue::face_blocks() const {
  using FoundBlocks = std::shared_ptr<const algebra3d::FaceBlocks>;
  A3D_TRY(database_->check_statement(value_.statement));
  const algebra3d::Type& type = *value_.layout->attributes()[value_.attribute].type;
  if (!may_have_face_blocks(type, value_.header.size) || database_->is_in_memory(value_)) return FoundBlocks();
  return found_face_blocks(database_);
}

std::shared_ptr<const algebra3d::DeferredSource> StoredValue::source() const {
  return std::make_shared<StoredValues>(database_, value_.layout, value_.statement);
}

void StoredValue::append_reference(std::string& bytes) const {
  const Reference reference{value_.tuple, value_.attribute, value_.header, value_.checksum, value_.time};
  bytes.append(reinterpret_cast<const char*>(&reference), sizeof reference);  // NOLINT(*-reinterpret-cast)
}

std::string StoredValue::presence_sql() const {
  const RelationLayout& layout = *value_.layout;
  return fmt::format("SELECT 1 FROM {} WHERE id = ? AND {} = ?", layout.table(),
                     layout.column(layout.attributes()[value_.attribute].box + kSumAfterBox));
}

Result<std::string> StoredValue::encoded() const {
  std::string copy;
  A3D_TRY(database_->with_bytes(value_, [&](std::string_view bytes) -> Status {
    copy = bytes;
    return {};
  }));
  return copy;
}

}  // namespace queries
