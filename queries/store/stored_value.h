#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "queries/store/database.h"

namespace queries {

/// A large attribute of a stored tuple that is read when it is asked for, once, while its statement runs.
class StoredValue final : public algebra3d::DeferredValue {
 public:
  StoredValue(std::shared_ptr<Database> database, LargeValue value)
      : database_(std::move(database)), value_(std::move(value)) {}

  algebra3d::GeometryHeader header() const override { return value_.header; }
  Result<Value> load() const override;

  const Database* database() const { return database_.get(); }
  /// The bytes as they are stored, for a copy that nobody decodes.
  Result<std::string> encoded() const;

 private:
  std::shared_ptr<Database> database_;
  LargeValue value_;
  mutable std::mutex mutex_;
  mutable std::optional<Value> loaded_;
};

}  // namespace queries
