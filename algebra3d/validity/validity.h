#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// What can be wrong with a triangle mesh that is to be a surface3d or volume3d (language.md 7.2).
enum class Defect : std::uint8_t {
  degenerate_triangle,     ///< corners repeat or are collinear
  duplicate_triangle,      ///< the same three corners as another triangle, in any order
  boundary_edge,           ///< volume: an edge with one triangle only
  nonmanifold_edge,        ///< volume: the triangles along the edge cannot be paired
  inconsistent_edge,       ///< volume: two triangles run along the edge in the same direction
  intersecting_triangles,  ///< the common part is neither one point nor a whole edge of both
  wrong_winding,           ///< volume: the winding number behind a triangle is not 1, or in front of it not 0
};
inline constexpr std::size_t kDefectKinds = 7;

/// One defect with its place, for people.
struct DefectExample {
  Defect kind;
  FaceId first;
  FaceId second;  ///< invalid where one triangle is concerned only
  Vec3 where;     ///< a point of the place, rounded
};

/// The outcome of a proof: nothing found, or every defect counted and the first ones named.
struct ValidityReport {
  static constexpr std::size_t kExamplesPerKind = 3;

  std::array<std::uint64_t, kDefectKinds> counts{};
  std::vector<DefectExample> examples;  ///< ascending by kind, then by face; at most kExamplesPerKind of a kind

  bool is_valid() const;
  std::uint64_t count(Defect kind) const { return counts[static_cast<std::size_t>(kind)]; }
  /// For people, one line: "12 boundary edges (first between triangles … at (x y z)); 3 intersecting pairs (…)".
  std::string text() const;
};

/// How far a proof goes once a defect is known.
enum class Thoroughness : std::uint8_t {
  first_defect,  ///< stop as soon as the mesh is known to be invalid, after the stage that found it
  all_defects,   ///< count all kinds, as far as a later kind makes sense after an earlier one
};

struct ProofOptions {
  Thoroughness thoroughness = Thoroughness::all_defects;
  const std::atomic<bool>* cancel = nullptr;  ///< asked often; error `interrupted`
};

/// Proves or refutes that `mesh` is a valid surface3d: no degenerate triangles; two triangles share no area, and if
/// they share a segment it is a whole edge of both; meeting in single points is allowed anywhere. Vertices must be
/// distinct points (weld first). Exact for all finite coordinates. Cost: near-linear in the triangles for meshes as
/// they occur. Source: candidate pairs from a box tree, exact triangle contacts of exact/predicates.h.
Result<ValidityReport> prove_surface(const TriangleMesh& mesh, const ProofOptions& options = {});

/// Proves or refutes that `mesh` is a valid volume3d: a valid surface, and the winding number is 0 or 1 everywhere off
/// the boundary, with 1 behind every triangle and 0 in front of it. Cavities, bodies within cavities, and bodies that
/// touch in points and edges are valid. Winding numbers: one exact vertical line per edge-connected component.
Result<ValidityReport> prove_volume(const TriangleMesh& mesh, const ProofOptions& options = {});

/// Signed winding number that a volume's boundary has on the front side of each edge-connected shell; used by import to
/// turn inside-out solids. See winding.h.

}  // namespace algebra3d
