#pragma once

#include <memory>
#include <span>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/arrangement/operand.h"
#include "algebra3d/kernel/arrangement/winding_vector.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// An arrangement of any number of solids: all faces, divided at one another, each with the winding number vectors of
/// the cells on both sides of it. `make` runs stages 0 to 8 of docs/set-operations.md and keeps what they give; `solid`
/// and `faces` run stage 9 for one rule (winding_vector.h), so several rules can use one arrangement. Immutable. Refers
/// to the meshes of the operands, and to the hierarchies given with them, which must outlive it; the list of operands
/// is copied.
class SolidArrangement {
 public:
  /// Makes the arrangement. Exactness: exact, for all valid operands. Errors: interrupted; limit_exceeded beyond
  /// TriangleMesh::kMaxFaces faces or a limit of the options; internal if operands are found to be invalid. Cost:
  /// near-linear in the faces of operands whose boxes meet, linear in those of the others.
  static Result<SolidArrangement> make(std::span<const Operand> operands, const Monitor& monitor = {},
                                       const ArrangementOptions& options = {});
  SolidArrangement(SolidArrangement&& other) noexcept;
  SolidArrangement& operator=(SolidArrangement&& other) noexcept;
  SolidArrangement(const SolidArrangement&) = delete;
  SolidArrangement& operator=(const SolidArrangement&) = delete;
  ~SolidArrangement();

  /// The regularised set operation of the rule: the closure of the interior of the set of points that it keeps. A valid
  /// volume, with cavities, nested bodies and bodies that touch; the empty mesh if nothing is kept. Vertices,
  /// minimality, errors and cost as of `faces`.
  Result<TriangleMesh> solid(const KeepRule& rule) const&;
  /// As above, for an arrangement that is not needed any more: frees its parts as soon as no step needs them.
  Result<TriangleMesh> solid(const KeepRule& rule) &&;
  /// The faces that the rule keeps: a valid surface. For rules that look at both sides of a face, as a section of a
  /// solid does; a solid needs `solid` only.
  ///
  /// Vertices of the result are vertices of the operands, or exact points in which three of their planes meet. Where
  /// operands touch, facets are merged and corners that nothing demands are left out; faces whose facet touches no
  /// other operand are taken over as they are: so of minimal operands the result is minimal (docs/set-operations.md).
  /// The same operands give the same triangles. Errors: internal, as make. Cost: as `make`, or less.
  Result<TriangleMesh> faces(const FaceRule& rule) const;

 private:
  struct Parts;
  explicit SolidArrangement(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

/// SolidArrangement::solid of the operands, for one rule.
Result<TriangleMesh> combine_solids(std::span<const Operand> operands, const KeepRule& rule,
                                    const Monitor& monitor = {});

}  // namespace algebra3d
