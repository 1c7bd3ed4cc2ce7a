#pragma once

#include <memory>
#include <string>

#include "queries/store/detail/database.h"

namespace queries {

/// A large attribute of a stored tuple, read on demand while its statement runs. Loaded values are kept in the
/// database's cache only.
class StoredValue final : public algebra3d::DeferredValue {
 public:
  StoredValue(std::shared_ptr<Database> database, LargeValue value)
      : database_(std::move(database)), value_(std::move(value)) {}

  algebra3d::GeometryHeader header() const override { return value_.header; }
  Result<Value> load() const override { return database_->load(value_); }
  std::shared_ptr<const algebra3d::DeferredSource> source() const override;
  void append_reference(std::string& bytes) const override;

  const Database* database() const { return database_.get(); }
  const LargeValue& place() const { return value_; }
  /// The stored bytes, for copying without decoding.
  Result<std::string> encoded() const;

 private:
  std::shared_ptr<Database> database_;
  LargeValue value_;
};

}  // namespace queries
