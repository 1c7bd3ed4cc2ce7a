#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The verdict on a volume that has changed.
struct ProofWithContacts {
  bool is_valid = false;
  /// If it is valid: how many vertices lie in faces without being their corners (vertex_contacts), where the face or
  /// one at the vertex has changed.
  std::size_t contact_vertices = 0;
};

/// Proves or refutes that a valid volume stays valid if some of its faces are replaced (with_replaced_faces,
/// halfedge/). `is_removed`: one flag per face of the volume. `added`: the faces in their place; a valid replacement
/// has the same boundary. `movement`, in coordinate units: the removed faces can be deformed into the added ones so
/// that no point moves farther. Exact. Errors: interrupted. Cost: a scan of all faces, some 10 ns each, and that of a
/// proof of the added faces and those whose boxes meet theirs; of the whole volume if one of its shells lies among
/// these alone.
Result<ProofWithContacts> prove_replacement(const TriangleMesh& volume, const std::vector<bool>& is_removed,
                                            const TriangleMesh& added, double movement,
                                            const std::atomic<bool>* cancel = nullptr);

}  // namespace algebra3d
