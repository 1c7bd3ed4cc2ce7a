#pragma once

#include <vector>

#include "algebra3d/values/types/value.h"
#include "queries/streams/datum.h"

namespace queries {

/// The value of a set(T), multiset(T) or vector(T): loaded values of one type. A set is in ascending order without
/// duplicates, a multiset in ascending order, a vector in the order of insertion. Undefined sorts first.
struct Collection {
  std::vector<Value> elements;
};

/// True for set(T), multiset(T) and vector(T).
bool is_collection(const TypeExpr& type);

/// A stream of the elements.
ValueStreamPtr elements_of(const Value& collection);

}  // namespace queries

/// The C++ type of all collections. It prints the elements alone; the type term of the expression says which collection
/// it is and of which type. It cannot be read back, and attributes and objects cannot have it.
template <>
struct algebra3d::TypeOf<queries::Collection> {
  static const Type& type();
};
