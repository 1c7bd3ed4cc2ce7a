#include "queries/streams/detail/keyed_tuple.h"

#include <algorithm>

#include "base/propagate.h"
#include "queries/streams/detail/sorting.h"

namespace queries {

Result<KeyedTuple> KeyedTuple::make(TuplePtr tuple, const std::vector<std::size_t>& attributes) {
  KeyedTuple result;
  const auto is_deferred = [&](std::size_t attribute) { return tuple->attributes[attribute].is_deferred(); };
  if (std::ranges::any_of(attributes, is_deferred)) {
    A3D_ASSIGN(std::vector<Value> keys, loaded_keys(*tuple, attributes));
    result.loaded_ = std::make_unique<const std::vector<Value>>(std::move(keys));
  }
  result.tuple_ = std::move(tuple);
  return result;
}

std::size_t KeyedTuple::bytes() const {
  std::size_t result = sizeof(KeyedTuple) + heap_bytes(*tuple_);
  if (loaded_ == nullptr) return result;
  for (const Value& key : *loaded_) result += sizeof(Value) + algebra3d::heap_bytes(key);
  return result;
}

}  // namespace queries
