#pragma once

#include <cstdint>

#include "algebra3d/types/value.h"

namespace algebra3d {

/// The class of the database type `tid`: what names a tuple within its relation. Positive, never used again while the
/// relation lives. A type of its own, so that operators find the attribute that holds it.
struct TupleNumber {
  std::int64_t number = 0;
};

template <>
struct TypeOf<TupleNumber> {
  static const Type& type();
};

}  // namespace algebra3d
