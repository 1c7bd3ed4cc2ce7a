#pragma once

#include <cstdint>

#include "algebra3d/values/types/value.h"

namespace algebra3d {

/// The class of the database type `tid`: the id of a tuple within its relation. Positive, never reused while the
/// relation exists. A separate type, so that operators can find the attribute with the id.
struct TupleNumber {
  std::int64_t number = 0;
};

template <>
struct TypeOf<TupleNumber> {
  static const Type& type();
};

}  // namespace algebra3d
