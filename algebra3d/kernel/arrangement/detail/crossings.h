#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/segment_complex.h"
#include "algebra3d/kernel/exact/intersection_point.h"
#include "base/id_map.h"

namespace algebra3d::arrangement {

/// An edge of an operand and a plane that it meets in a point.
struct EdgeAndPlane {
  InputEdgeId edge;
  PlaneId plane;

  /// Both in one number.
  std::uint64_t key() const { return std::uint64_t{edge.index()} << 32U | plane.index(); }
};

/// The nodes of a segment complex in which segments cross, made when they are asked for and then remembered. Used by
/// stages 4 and 5. None is computed from a computed one: each is an edge of an operand met by a plane, two such edges
/// that cross in a plane, or three planes.
class Crossings {
 public:
  Crossings(const Operands& operands, const Facets& facets, SegmentComplex& complex)
      : operands_(operands), facets_(facets), complex_(complex) {}

  /// Makes room for so many points in which edges meet planes.
  void reserve(std::size_t count);
  /// The node where an edge meets a plane in one point. Exact.
  NodeId of_edge_and_plane(const EdgeAndPlane& where);
  /// The node where three planes meet in one point. Exact.
  NodeId of_planes(PlaneId p, PlaneId q, PlaneId r);
  /// The node where two edges of operands cross that lie in one plane with this projection. Exact.
  NodeId of_edges(InputEdgeId edge, InputEdgeId other, Projection projection);

  /// Computes points in which edges meet planes, in parallel if they are many. They become nodes once they are asked
  /// for; those that nobody has asked for by the next call are forgotten then.
  void compute(std::span<const EdgeAndPlane> wanted);

 private:
  using CrossingId = StrongId<struct CrossingTag>;

  ExactPoint meeting_point(const EdgeAndPlane& where);
  std::optional<ExactPoint> point_by_planes(InputEdgeId edge, const IntegerPlane& plane) const;
  ExactPoint take_point(CrossingId crossing, const EdgeAndPlane& where);
  PointRef start(InputEdgeId edge) const { return operands_.point(Operands::halfedge(edge)); }
  PointRef end(InputEdgeId edge) const { return operands_.point(Operands::next(Operands::halfedge(edge))); }

  const Operands& operands_;
  const Facets& facets_;
  SegmentComplex& complex_;
  IdMap<CrossingId> of_edges_and_planes_;
  IdVector<CrossingId, NodeId> nodes_;  // of edges and planes; none: not asked for yet
  // Points of the last call of `compute`, of which that of the first crossing comes first.
  std::vector<ExactPoint> points_;
  CrossingId first_point_{0};
  std::map<std::array<PlaneId, 3>, NodeId> of_planes_;
};

}  // namespace algebra3d::arrangement
