#pragma once

#include "algebra3d/kernel/exact/exact_work.h"
#include "algebra3d/kernel/validity/validity.h"

namespace algebra3d {

/// prove_surface within a limit of the work with exact numbers, for meshes with coordinates of all sizes, whose points
/// of intersection have thousands of bits. Errors: also limit_exceeded; the same meshes exceed it each time.
Result<ValidityReport> prove_surface(const TriangleMesh& mesh, const ProofOptions& options, ExactWorkLimit& limit);

}  // namespace algebra3d
