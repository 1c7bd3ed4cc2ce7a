#pragma once

#include <compare>
#include <concepts>
#include <cstdint>

#include "algebra3d/base/strong_id.h"

/// Identifiers of an arrangement. A mesh has handles of its own (VertexId, HalfedgeId, FaceId in halfedge/handle.h),
/// which mean something within one operand; the `Input` ids count the elements of all operands consecutively, those of
/// the first operand first (operands.h).
namespace algebra3d::arrangement {

/// An operand, in the order in which they were given.
using OperandId = StrongId<struct OperandTag>;

/// A triangle of an operand.
using InputFaceId = StrongId<struct InputFaceTag>;
/// A half-edge of an operand: those of face f are 3f, 3f + 1, 3f + 2, as in every mesh; Operands has the functions.
using InputHalfedgeId = StrongId<struct InputHalfedgeTag>;
/// A vertex of an operand: a corner of its triangles.
using InputVertexId = StrongId<struct InputVertexTag>;
/// An edge of an operand. Its index is that of the lowest half-edge along it (Operands::edge).
using InputEdgeId = StrongId<struct InputEdgeTag>;

/// A coplanar facet of an operand (facets.h).
using FacetId = StrongId<struct FacetTag>;
/// A plane with facets in it (facets.h).
using PlaneId = StrongId<struct PlaneTag>;

/// A node: a vertex of the arrangement, as opposed to one of a mesh. Nodes are distinct points (segment_complex.h).
using NodeId = StrongId<struct NodeTag>;
/// A segment of the segment complex (segment_complex.h).
using SegmentId = StrongId<struct SegmentTag>;
/// A sub-edge (sub_edges.h).
using SubEdgeId = StrongId<struct SubEdgeTag>;
/// A patch of an operand (patches.h).
using PatchId = StrongId<struct PatchTag>;

/// A side of a directed edge in a plane, for someone who looks at the front of the plane and walks along the edge.
enum class Side : std::uint8_t { left, right };

/// The other side.
constexpr Side opposite(Side side) {
  return side == Side::left ? Side::right : Side::left;
}

/// A side of a sub-edge. Stands for the side, for the half-plane there (radial_order.h), and for the sub-facet that
/// begins there (sub_edges.h): a sub-facet has no id of its own, but one of these for each side of a sub-edge that
/// bounds it. The ids of sub-edge e are 2e (left) and 2e + 1 (right).
class SubEdgeSide {
 public:
  constexpr SubEdgeSide() = default;
  template <std::integral Integer>
  constexpr explicit SubEdgeSide(Integer index) : id_(index) {}
  constexpr SubEdgeSide(SubEdgeId sub_edge, Side side) : id_(2 * sub_edge.index() + static_cast<std::uint32_t>(side)) {}

  constexpr SubEdgeId sub_edge() const { return SubEdgeId(id_.index() / 2); }
  constexpr Side side() const { return static_cast<Side>(id_.index() % 2); }
  constexpr std::uint32_t index() const { return id_.index(); }
  constexpr bool is_none() const { return id_.is_none(); }

  friend constexpr auto operator<=>(SubEdgeSide, SubEdgeSide) = default;  // NOLINT(modernize-use-nullptr)

 private:
  StrongId<struct SubEdgeSideTag> id_;
};

/// Both sides.
inline constexpr Side kSides[] = {Side::left, Side::right};

}  // namespace algebra3d::arrangement
