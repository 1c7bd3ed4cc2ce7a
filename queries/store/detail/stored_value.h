#pragma once

#include <memory>
#include <string>

#include "queries/store/detail/database.h"
#include "queries/store/detail/shape_levels.h"

namespace queries {

/// A large value whose bytes lie in a database: an attribute of a tuple, or the value of an object.
class StoredBytes : public algebra3d::DeferredValue {
 public:
  virtual const Database* database() const = 0;
  /// Of the bytes.
  virtual std::uint64_t checksum() const = 0;
  /// Where its levels of detail lie.
  virtual LevelPlace level_place() const = 0;
  /// A query with a row if the file holds this very value: the tuple of `level_place`, the checksum.
  virtual std::string presence_sql() const = 0;

 protected:
  /// The face blocks of this value. If it has none yet, it is loaded, and they are kept when the statement has ended.
  Result<std::shared_ptr<const algebra3d::FaceBlocks>> found_face_blocks(
      const std::shared_ptr<Database>& database) const;
};

/// A large attribute of a stored tuple, read on demand while its statement runs. Loaded values are kept in the
/// database's cache only.
class StoredValue final : public StoredBytes {
 public:
  StoredValue(std::shared_ptr<Database> database, LargeValue value)
      : database_(std::move(database)), value_(std::move(value)) {}

  algebra3d::GeometryHeader header() const override { return value_.header; }
  Result<Value> load() const override { return database_->load(value_); }
  Result<std::shared_ptr<const algebra3d::FaceBlocks>> face_blocks() const override;
  std::shared_ptr<const algebra3d::DeferredSource> source() const override;
  void append_reference(std::string& bytes) const override;

  const Database* database() const override { return database_.get(); }
  std::uint64_t checksum() const override { return value_.checksum; }
  LevelPlace level_place() const override {
    return {value_.layout->table_number(), value_.tuple, static_cast<std::int64_t>(value_.attribute)};
  }
  std::string presence_sql() const override;
  const LargeValue& place() const { return value_; }
  /// The stored bytes, for copying without decoding.
  Result<std::string> encoded() const;

 private:
  std::shared_ptr<Database> database_;
  LargeValue value_;
};

}  // namespace queries
