#pragma once

#include <vector>

#include "algebra3d/arrangement/arrangement.h"
#include "algebra3d/arrangement/patches.h"
#include "algebra3d/arrangement/pieces.h"
#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"

namespace algebra3d::arrangement {

/// The windings in front of everything that may bound a result.
struct Classification {
  /// In front of the plane, in the cell on each side of each piece: twice the piece for the left side, one more for the
  /// right. Means something where the cell has a step that is not zero.
  std::vector<Windings> cell_fronts;
  /// In front of each patch.
  std::vector<Windings> patch_fronts;
};

/// Round each line the radial order says how windings change from cell to cell; round each vertex cells are the same
/// from piece to piece; across clean edges they go on into patches. What hangs together so is known up to a constant,
/// which one place gives: there the windings of operands that have a face are known from this face, and those of others
/// from a vertical line; those of operands that are closed only together all come from the line.
/// Errors: interrupted. Exact.
Result<Classification> classify(const Skeleton& skeleton, const Pieces& pieces, const Patches& patches, Closure closure,
                                const Monitor& monitor);

}  // namespace algebra3d::arrangement
