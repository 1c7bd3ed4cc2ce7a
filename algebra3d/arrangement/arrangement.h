#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/halfedge/box_hierarchy.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// One solid, or part of a closed surface, that takes part in an arrangement.
struct Operand {
  const TriangleMesh* mesh = nullptr;  ///< see Closure
  /// 0 or 1: what the rule does not tell apart is one group.
  std::uint32_t group = 0;
  /// Over all faces of the mesh, if there is one already; null: one is made where it is needed.
  const BoxHierarchy* hierarchy = nullptr;
};

/// What bounds what holds a place.
enum class Closure : std::uint8_t {
  /// Every operand is a valid volume (validity.h).
  each,
  /// Every operand is a valid surface without non-manifold edges, and those of one group together are closed: along
  /// every line they run as often one way as the other. They may pass through each other and lie upon each other.
  together,
};

struct ArrangementOptions {
  Closure closure = Closure::each;
  /// Of faces whose boxes meet: with more of them the arrangement is not made (limit_exceeded).
  std::size_t max_pairs = SIZE_MAX;
  /// Of cuts where triangles cross: there may be as many as the cube of the triangles.
  std::size_t max_cuts = SIZE_MAX;
};

/// How many operands of each group hold a place; of operands that are closed together, their winding number about it.
using Holding = std::array<std::int32_t, 2>;
/// Says of a place off all boundaries whether the result holds it. False where no operand does.
using KeepRule = std::function<bool(const Holding& holding)>;
/// Says of a face of the arrangement, by the operands that hold the room in front of it and behind it, whether the
/// result has it: 1, or -1 for the face turned over, or 0.
using FaceRule = std::function<int(const Holding& front, const Holding& back)>;

/// Any number of solids, divided at one another: all faces, cut where they meet, each with the operands that hold the
/// room on both sides of it. Immutable.
class SolidArrangement {
 public:
  /// The meshes must outlive the arrangement. Exactness: exact, for all valid operands. Errors: interrupted;
  /// limit_exceeded beyond TriangleMesh::kMaxFaces faces, or the limit of the options.
  /// Cost: near-linear in the faces of operands whose boxes meet, linear in those of the others.
  static Result<SolidArrangement> make(std::span<const Operand> operands, const Monitor& monitor = {},
                                       const ArrangementOptions& options = {});
  SolidArrangement(SolidArrangement&& other) noexcept;
  SolidArrangement& operator=(SolidArrangement&& other) noexcept;
  SolidArrangement(const SolidArrangement&) = delete;
  SolidArrangement& operator=(const SolidArrangement&) = delete;
  ~SolidArrangement();

  /// The regularised set operation that the rule says: the closure of the inside of the set of places that it keeps. A
  /// valid volume: cavities, nested bodies and bodies that touch included; the empty mesh if nothing is kept.
  Result<TriangleMesh> solid(const KeepRule& rule) const;
  /// The faces that the rule keeps: a valid surface.
  ///
  /// Vertices of this and of `solid` are vertices of the operands, or the exact points in which three of their planes
  /// meet. Where operands touch, facets are merged and corners that nothing demands are left out; faces that touch no
  /// other operand are taken over as they are: so of minimal operands the result is minimal (docs/set-operations.md).
  /// The same operands give the same triangles. Errors: internal, see build_outcome. Cost: as `make`, or less.
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
