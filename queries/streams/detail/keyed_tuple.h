#pragma once

#include <memory>
#include <vector>

#include "queries/streams/datum.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {

/// A tuple with the loaded values of its key attributes.
class KeyedTuple {
 public:
  /// Errors: those of loading.
  static Result<KeyedTuple> make(TuplePtr tuple, const std::vector<std::size_t>& attributes);

  const TuplePtr& tuple() const { return tuple_; }
  TuplePtr& tuple() { return tuple_; }
  /// The value of `attributes[which]`; `attributes` as given to `make`.
  const Value& key(const std::vector<std::size_t>& attributes, std::size_t which) const {
    return loaded_ != nullptr ? (*loaded_)[which] : tuple_->attributes[attributes[which]];
  }
  /// Estimated memory.
  std::size_t bytes() const;

 private:
  TuplePtr tuple_;
  std::unique_ptr<const std::vector<Value>> loaded_;  // null: the tuple itself has all keys loaded
};

}  // namespace queries
