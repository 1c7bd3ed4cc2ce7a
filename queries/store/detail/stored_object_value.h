#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "queries/store/detail/stored_value.h"

namespace queries {

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

}  // namespace queries
