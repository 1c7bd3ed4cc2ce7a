#pragma once

#include <functional>

#include "algebra3d/arrangement/patches.h"
#include "algebra3d/arrangement/pieces.h"
#include "algebra3d/base/error.h"

namespace algebra3d::arrangement {

/// What a result has of the cells and patches of an arrangement: 1 for one that it has, -1 for one that it has turned
/// over, 0 for others.
struct Selection {
  /// Of the cell on a side of a piece, seen from the front of its plane: twice the piece for the left side, one more
  /// for the right. Called for sides that a facet covers.
  std::function<int(std::uint32_t cell_side)> cell;
  std::function<int(std::uint32_t patch)> patch;
};

/// The mesh of what is selected: facets are brought together where nothing parts them any more, vertices in the middle
/// of straight edges are left out, and each facet is triangulated anew; patches are taken over as they are.
/// Errors: `internal` if edges of what is kept in a plane bound no region there, which the selection of a correct
/// classification rules out.
Result<TriangleMesh> build_outcome(const Skeleton& skeleton, const Pieces& pieces, const Patches& patches,
                                   const Selection& selection);

}  // namespace algebra3d::arrangement
