#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/mesh_image.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/validity/face_pairs.h"
#include "algebra3d/kernel/validity/face_set.h"
#include "algebra3d/kernel/validity/report.h"

namespace algebra3d {

/// Whether a proof stops at the first defect.
enum class Thoroughness : std::uint8_t {
  first_defect,  ///< stop at the first defect; at most one intersecting pair is reported
  all_defects,   ///< count all defects, except kinds that make no sense after earlier ones
};

struct ProofOptions {
  Thoroughness thoroughness = Thoroughness::all_defects;
  const std::atomic<bool>* cancel = nullptr;  ///< checked often; error `interrupted`
  /// Maximum number of intersecting pairs to count (`ValidityReport::is_cut_short`): there may be quadratically many.
  std::uint64_t max_intersecting_pairs = 1'000'000;
  /// Faces known from an earlier proof to be a valid surface by themselves; pairs of them are not tested again. A wrong
  /// set makes the proof wrong.
  FaceSet known = {};
  /// The valid surface or volume of which the mesh is the rounded image, with the same faces in the same order, if any.
  Preimage preimage = {};
};

/// Proves or refutes that `mesh` is a valid surface3d: no degenerate triangles; two triangles share no area, and a
/// segment only if it is a whole edge of both; they may meet in single points. Vertices must be distinct points (weld
/// first); otherwise coinciding edges count as intersections. Degenerate and duplicate triangles are reported as such
/// and are excluded from the search for intersections. Exact for all finite coordinates. Errors: interrupted. Cost:
/// near-linear in the triangles for usual meshes.
Result<ValidityReport> prove_surface(const TriangleMesh& mesh, const ProofOptions& options = {});

/// Proves or refutes that `mesh` is a valid volume3d: a valid surface, and the winding number is 0 or 1 everywhere off
/// the boundary, with 1 behind every triangle and 0 in front of it. Cavities, bodies within cavities, and bodies that
/// touch in points and edges are valid. Winding numbers (winding.h) are checked only if there is no other defect.
/// Errors: interrupted. Cost: that of prove_surface, and one vertical line per shell.
Result<ValidityReport> prove_volume(const TriangleMesh& mesh, const ProofOptions& options = {});

/// The result of examine_volume.
struct VolumeExamination {
  ValidityReport report;
  /// Faces that are neither degenerate nor duplicates and intersect no other such face in more than a point or a whole
  /// edge: they, and all subsets, are a valid surface by themselves, in any mesh. Empty if not all intersecting pairs
  /// were counted.
  FaceSet free;
};

/// prove_volume that counts all defects and returns the faces without intersections.
Result<VolumeExamination> examine_volume(const TriangleMesh& mesh, const std::atomic<bool>* cancel = nullptr);

/// The faces of any mesh that cross each other. Degenerate faces cross nothing.
struct Crossings {
  FacePairs pairs;                 ///< faces that share more than a point or a whole edge of both; ascending
  std::vector<FaceId> duplicates;  ///< faces with the corners of an earlier one, which no pair has; ascending
};

/// Finds all pairs of faces that cross, of which there may be quadratically many. Errors: interrupted. Exact. Cost:
/// that of prove_surface.
Result<Crossings> find_crossings(const TriangleMesh& mesh, const std::atomic<bool>* cancel = nullptr);

/// The relation of a face of a mesh to the others.
enum class Entanglement : std::uint8_t {
  none,        ///< shares at most a point or a whole edge with other such faces
  entangled,   ///< duplicates or crosses another face, or has an edge that is not allowed
  degenerate,  ///< the face has no area
};

/// Which edges a face may have without being entangled.
enum class AllowedEdges : std::uint8_t { manifold, any };

/// Classifies the faces of any mesh so that those with Entanglement::none are a valid surface by themselves. Of two
/// faces that intersect the later one is entangled, unless the earlier one is already. `known` as in ProofOptions.
/// Errors: interrupted. Exact. Cost: that of prove_surface.
Result<std::vector<Entanglement>> disentangle(const TriangleMesh& mesh, const std::atomic<bool>* cancel = nullptr,
                                              const FaceSet& known = {}, AllowedEdges edges = AllowedEdges::manifold);

}  // namespace algebra3d
