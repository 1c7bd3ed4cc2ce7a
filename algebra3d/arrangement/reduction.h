#pragma once

#include <span>

#include "algebra3d/arrangement/arrangement.h"

namespace algebra3d {

/// The union of any number of solids, whatever their groups; the empty mesh if there are none.
/// The intersection of at least one.
///
/// Where many overlap, they are halved by their places, the halves united (or intersected) by themselves, at the same
/// time if there are processors, and then the two results: what is inside of others is gone early, where one
/// arrangement of n solids that all cross one another has some n^3 pieces. The same solids in the same order give the
/// same triangles. Exactness, errors: as combine_solids. Cost: as that, or a logarithm more often, of parts.
Result<TriangleMesh> unite_solids(std::span<const Operand> solids, const Monitor& monitor = {});
Result<TriangleMesh> intersect_solids(std::span<const Operand> solids, const Monitor& monitor = {});

}  // namespace algebra3d
