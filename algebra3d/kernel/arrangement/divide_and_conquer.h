#pragma once

#include <span>

#include "algebra3d/kernel/arrangement/arrangement.h"

namespace algebra3d {

/// The union of any number of solids, regardless of their groups; the empty mesh if there are none.
///
/// A divide-and-conquer union (docs/set-operations.md) if there are more than eight solids and many of them overlap:
/// they are divided into two halves by position, the halves united by themselves, at the same time if there are
/// processors, and then the two results. So what is inside of others is gone early; one arrangement of n solids that
/// all cross one another has some n^3 sub-edges. Otherwise one arrangement. The same solids in the same order give the
/// same triangles. Exactness, errors: as combine_solids. Cost: that of the arrangements of one level, times the
/// logarithm of the number of solids.
Result<TriangleMesh> unite_solids(std::span<const Operand> solids, const Monitor& monitor = {});

/// The intersection of at least one solid, by the same method.
Result<TriangleMesh> intersect_solids(std::span<const Operand> solids, const Monitor& monitor = {});

}  // namespace algebra3d
