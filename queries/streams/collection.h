#pragma once

#include <vector>

#include "algebra3d/types/value.h"
#include "queries/streams/datum.h"

namespace queries {

/// What a set(T), multiset(T) or vector(T) holds: loaded values of one type. A set is in ascending order without
/// duplicates, a multiset in ascending order, a vector in the order of its making. Undefined comes first.
struct Collection {
  std::vector<Value> elements;
};

/// True for set(T), multiset(T) and vector(T).
bool is_collection(const TypeExpr& type);

/// The elements, one after the other.
ValueStreamPtr elements_of(const Value& collection);

}  // namespace queries

/// The C++ type of all collections. It prints elements only: which collection it is, and of what, the type term of the
/// expression says. So it cannot be read, and is no type of attributes or objects.
template <>
struct algebra3d::TypeOf<queries::Collection> {
  static const Type& type();
};
