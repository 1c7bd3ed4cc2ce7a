#pragma once

#include <atomic>
#include <functional>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/exact/exact_work.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "algebra3d/kernel/validity/detail/proved_parts.h"
#include "algebra3d/kernel/validity/face_pairs.h"
#include "algebra3d/kernel/validity/validity.h"

namespace algebra3d {

/// Calls visit(f, g), f < g, for every pair of faces whose intersection is not empty, nor one point, nor a whole edge
/// of both; always in the same order. Ends when it returns false. `only_first`: it does so at the first one. Returns
/// the pairs that have one point in common and no corner, all of them if visit was never called or always returned
/// true, in the same order. The faces must not be degenerate or duplicates, and known faces must not intersect each
/// other: pairs of them are left out. Sets the groups of the hierarchy. Exact. Errors: interrupted; limit_exceeded, if
/// there is a limit. Cost: that of the pairs whose boxes meet; pairs in one height field, or at a common embedded
/// corner, cost a few nanoseconds or nothing.
Result<FacePairs> for_each_intersection(const TriangleMesh& mesh, const ProvedParts& proved, BoxHierarchy& hierarchy,
                                        const std::atomic<bool>* cancel,
                                        const std::function<bool(FaceId, FaceId)>& visit, bool only_first = false,
                                        ExactWorkLimit* limit = nullptr);

/// Adds the pairs of for_each_intersection to `report` and removes their faces from `free`, unless that is empty. Stops
/// after the first pair if `options` say so. Returns the pairs that touch in a point, as above.
Result<FacePairs> find_intersections(const TriangleMesh& mesh, const ProvedParts& proved, BoxHierarchy& hierarchy,
                                     const ProofOptions& options, ValidityReport& report, FaceSet& free,
                                     ExactWorkLimit* limit = nullptr);

}  // namespace algebra3d
