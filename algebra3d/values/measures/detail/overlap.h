#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

/// The common part of two solids of which neither is inside the other, as far as a clash needs it.
struct Overlap {
  /// True if one of them divides a body of the other: the rest of the body is not connected.
  bool is_divided = false;
  Surface3d of_first_in_second, of_second_in_first;  ///< the parts of the boundaries in the interior of the other

  /// Exact. Errors: interrupted, limit_exceeded. Cost: that of an arrangement of both.
  static Result<Overlap> of(const Volume3d& a, const Volume3d& b, const Monitor& monitor);
};

}  // namespace algebra3d
