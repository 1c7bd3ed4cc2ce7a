#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/halfedge/box_hierarchy.h"
#include "algebra3d/halfedge/mesh_image.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// Shells of a mesh: its faces, connected across common edges (also non-manifold ones; common corners do not connect),
/// with the winding number of the whole mesh just in front of each shell; just behind it, the number is one more.
struct ShellWindings {
  std::vector<std::uint32_t> shell_of_face;  ///< shells numbered from 0 in order of their lowest faces
  std::vector<std::uint32_t> first_faces;    ///< per shell: its lowest face
  std::vector<int> fronts;                   ///< per shell; 0 where all is well

  /// True if turning every triangle over gives a valid volume.
  bool is_inside_out() const;
};

/// Requires a mesh of which prove_volume finds no defect but wrong windings. Refers to `hierarchy` over all its faces.
/// Errors: interrupted. Exact. Cost: linear for the shells; for each of a few shells one vertical ray, for each of many
/// one search for the face above its top (shell_tops.h).
Result<ShellWindings> find_shell_windings(const TriangleMesh& mesh, const BoxHierarchy& hierarchy,
                                          const std::atomic<bool>* cancel = nullptr);
/// The same for the rounded image of a valid volume. `near` is over the faces of the preimage, with boxes that meet if
/// the faces are within reach. Cost: linear, and the pairs whose boxes meet; that of the other functions for shells of
/// which such a pair joins one to another.
Result<ShellWindings> find_shell_windings(const TriangleMesh& mesh, const Preimage& preimage, const BoxHierarchy& near,
                                          const std::atomic<bool>* cancel = nullptr);
/// The same with a hierarchy of its own.
Result<ShellWindings> find_shell_windings(const TriangleMesh& mesh, const std::atomic<bool>* cancel = nullptr);

}  // namespace algebra3d
