#include "queries/store/stored_value.h"

namespace queries {

// Two threads may load the same value at the same time; the second one finds it in the cache or decodes it again.
Result<Value> StoredValue::load() const {
  {
    const std::lock_guard lock(mutex_);
    if (loaded_) return *loaded_;
  }
  ASSIGN_OR_RETURN(Value value, database_->load(value_));
  const std::lock_guard lock(mutex_);
  if (!loaded_) loaded_ = value;
  return value;
}

Result<std::string> StoredValue::encoded() const {
  std::string copy;
  RETURN_IF_ERROR(database_->with_bytes(value_, [&](std::string_view bytes) -> Status {
    copy = bytes;
    return {};
  }));
  return copy;
}

}  // namespace queries
