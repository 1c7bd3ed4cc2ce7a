#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "base/propagate.h"
#include "queries/streams/mapping.h"

namespace queries {

/// A stream in which `change(from, attributes)` has replaced each tuple of the operand. The new tuples have no id.
template <typename Change>
Datum changed_tuples(const TupleStreamPtr& tuples, Change change) {
  return Datum{make_stream([tuples, change = std::move(change)]() mutable -> Result<TuplePtr> {
    A3D_ASSIGN(const TuplePtr tuple, tuples->next());
    if (tuple == nullptr) return TuplePtr();
    Tuple result;
    A3D_TRY(change(tuple, result.attributes));
    return TuplePtr(std::make_shared<const Tuple>(std::move(result)));
  })};
}

/// All attributes of a tuple, with capacity for `more` further ones.
inline std::vector<Value> extended_attributes(const Tuple& from, std::size_t more) {
  std::vector<Value> attributes;
  attributes.reserve(from.attributes.size() + more);
  attributes.insert(attributes.end(), from.attributes.begin(), from.attributes.end());
  return attributes;
}
/// Appends the attributes at `indices` of a tuple to `to`.
inline Status append_attributes(const Tuple& from, const std::vector<std::size_t>& indices, std::vector<Value>& to) {
  to.reserve(to.size() + indices.size());
  for (const std::size_t index : indices) to.push_back(from.attributes[index]);
  return {};
}

}  // namespace queries
