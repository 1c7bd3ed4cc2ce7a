#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/halfedge/mesh_image.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/validity/face_set.h"
#include "algebra3d/validity/report.h"

namespace algebra3d {

/// How far a proof goes once a defect is known.
enum class Thoroughness : std::uint8_t {
  first_defect,  ///< stop as soon as the mesh is known to be invalid; of intersecting pairs one is named
  all_defects,   ///< count all kinds, as far as a later kind makes sense after an earlier one
};

struct ProofOptions {
  Thoroughness thoroughness = Thoroughness::all_defects;
  const std::atomic<bool>* cancel = nullptr;  ///< asked often; error `interrupted`
  /// Counting of intersecting pairs ends here (`ValidityReport::is_cut_short`): there may be quadratically many.
  std::uint64_t max_intersecting_pairs = 1'000'000;
  /// Faces that are known to be a valid surface by themselves, from an earlier proof: they are not looked at again
  /// beside each other. A wrong set makes a wrong proof.
  FaceSet known = {};
  /// A valid surface or volume with the same faces, in their order, of which the mesh is the rounded image, if there is
  /// one.
  Preimage preimage = {};
};

/// Proves or refutes that `mesh` is a valid surface3d: no degenerate triangles; two triangles share no area, and if
/// they share a segment it is a whole edge of both; meeting in single points is allowed anywhere. Vertices must be
/// distinct points (weld first): where they are not, coinciding edges count as intersections. Degenerate triangles and
/// repeated ones are named as such and take no part in the search for intersections. Exact for all finite coordinates.
/// Errors: interrupted. Cost: near-linear in the triangles for meshes as they occur.
Result<ValidityReport> prove_surface(const TriangleMesh& mesh, const ProofOptions& options = {});

/// Proves or refutes that `mesh` is a valid volume3d: a valid surface, and the winding number is 0 or 1 everywhere off
/// the boundary, with 1 behind every triangle and 0 in front of it. Cavities, bodies within cavities, and bodies that
/// touch in points and edges are valid. Winding numbers (winding.h) are asked only if nothing else is wrong.
/// Errors: interrupted. Cost: that of prove_surface, and one vertical line per shell.
Result<ValidityReport> prove_volume(const TriangleMesh& mesh, const ProofOptions& options = {});

/// What a proof has found out about a mesh, be it valid or not.
struct VolumeExamination {
  ValidityReport report;
  /// Faces that are neither degenerate nor a repetition of an earlier one, and share more than a point or a whole edge
  /// with no other such face: they are a valid surface by themselves, and so is any part of them, in any other mesh.
  /// Empty if intersecting pairs were not all counted.
  FaceSet free;
};

/// prove_volume that counts all defects, and tells which faces have none but at their edges.
Result<VolumeExamination> examine_volume(const TriangleMesh& mesh, const std::atomic<bool>* cancel = nullptr);

/// How the faces of a mesh stand to the others.
enum class Entanglement : std::uint8_t {
  none,        ///< no two such faces share more than a point or a whole edge
  entangled,   ///< duplicates another face, passes through one, or has an edge that is not manifold
  degenerate,  ///< has no area
};

/// Parts the faces of any mesh so that those with Entanglement::none are a valid surface by themselves. Of two faces
/// that share too much the later one is called entangled, unless the earlier one is already.
/// `known` as in ProofOptions. Errors: interrupted. Exact. Cost: that of prove_surface.
Result<std::vector<Entanglement>> disentangle(const TriangleMesh& mesh, const std::atomic<bool>* cancel = nullptr,
                                              const FaceSet& known = {});

}  // namespace algebra3d
