#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/mesh_image.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "algebra3d/kernel/validity/detail/height_fields.h"

namespace algebra3d {

/// The shells of a mesh (faces connected across common edges, also non-manifold ones) with the winding number of the
/// whole mesh just in front of each shell; just behind it the number is one more.
struct ShellWindings {
  std::vector<std::uint32_t> shell_of_face;  ///< shells numbered from 0 in order of their lowest faces
  std::vector<std::uint32_t> first_faces;    ///< per shell: its lowest face
  std::vector<int> fronts;                   ///< per shell: the winding number in front; 0 in a valid volume

  /// True if the flipped mesh is a valid volume.
  bool is_inside_out() const;
};

/// Computes the shells, from the regions of `fields`, and their winding numbers. Requires a mesh without other defects
/// of prove_volume, and a `hierarchy` over all its faces. Errors: interrupted. Exact. Cost: linear for the shells; for
/// each of a few shells one vertical ray, for each of many one search for the face above its top (shell_tops.h).
Result<ShellWindings> find_shell_windings(const TriangleMesh& mesh, const HeightFields& fields,
                                          const BoxHierarchy& hierarchy, const std::atomic<bool>* cancel = nullptr);
/// As above, for the rounded image of a valid volume. `near`: a hierarchy over the faces of the preimage, whose boxes
/// meet if the faces are within reach. Cost: linear, and the pairs whose boxes meet; for shells joined by such a pair
/// that of the other overloads.
Result<ShellWindings> find_shell_windings(const TriangleMesh& mesh, const HeightFields& fields,
                                          const Preimage& preimage, const BoxHierarchy& near,
                                          const std::atomic<bool>* cancel = nullptr);
/// As above; also finds the regions and builds the hierarchy.
Result<ShellWindings> find_shell_windings(const TriangleMesh& mesh, const std::atomic<bool>* cancel = nullptr);

}  // namespace algebra3d
