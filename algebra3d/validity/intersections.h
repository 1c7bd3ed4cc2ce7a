#pragma once

#include <atomic>
#include <functional>

#include "algebra3d/base/error.h"
#include "algebra3d/halfedge/box_hierarchy.h"
#include "algebra3d/validity/validity.h"
#include "algebra3d/validity/vertex_stars.h"

namespace algebra3d {

/// Calls visit(f, g), f < g, for every pair of the hierarchy's faces whose common part is neither nothing, nor one
/// point, nor a whole edge of both; ends early when it returns false. None of the faces may be degenerate or repeat
/// another, and no two faces in `known` make such a pair. Gives the hierarchy its groups. Exact. Errors: interrupted.
/// Cost: that of the pairs whose boxes meet; pairs at a common embedded corner cost a few nanoseconds.
Status for_each_intersection(const TriangleMesh& mesh, const EmbeddedStars& stars, const FaceSet& known,
                             BoxHierarchy& hierarchy, const std::atomic<bool>* cancel,
                             const std::function<bool(FaceId, FaceId)>& visit);

/// Adds to `report` what for_each_intersection finds, and takes it out of `free`, unless that is empty; after the first
/// one it stops if that is all that `options` wants.
Status find_intersections(const TriangleMesh& mesh, const EmbeddedStars& stars, BoxHierarchy& hierarchy,
                          const ProofOptions& options, ValidityReport& report, FaceSet& free);

}  // namespace algebra3d
