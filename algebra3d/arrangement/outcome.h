#pragma once

#include "algebra3d/arrangement/arrangement.h"
#include "algebra3d/arrangement/classification.h"

namespace algebra3d::arrangement {

/// The mesh of the faces that the rule keeps: facets are brought together where nothing parts them any more, vertices
/// in the middle of straight edges are left out, and each facet is triangulated anew; patches are taken over as they
/// are.
TriangleMesh build_outcome(const Skeleton& skeleton, const Pieces& pieces, const Patches& patches,
                           const Classification& classification, const FaceRule& rule);

}  // namespace algebra3d::arrangement
