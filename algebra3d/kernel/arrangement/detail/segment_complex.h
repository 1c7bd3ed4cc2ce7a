#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/facets.h"
#include "algebra3d/kernel/arrangement/detail/ids.h"
#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/exact/point_table.h"

namespace algebra3d::arrangement {

/// The exact coefficients of planes, per PlaneId, computed when they are asked for. From stage 4 on all stages take
/// them from here; stages 2 and 3, which have faces and no PlaneIds yet, use PlanesOfFaces, whose results come along as
/// Plane::coefficients.
class PlaneCoefficients {
 public:
  PlaneCoefficients() = default;
  explicit PlaneCoefficients(const Facets& facets);

  /// The coefficients of a plane. `facets` must be those given to the constructor. Cost: a few products of integers at
  /// the first call for a plane.
  const IntegerPlane& get(const Facets& facets, PlaneId plane);
  /// Computes the coefficients of many planes at once, each listed once, in parallel if they are very many; `get` then
  /// finds them.
  void compute(const Facets& facets, std::span<const PlaneId> planes);
  /// Like `get`, but computes unknown coefficients without caching them. For stage 9, where the complex is constant.
  IntegerPlane find_or_compute(const Facets& facets, PlaneId plane) const;

 private:
  IdVector<PlaneId, IntegerPlane> known_;  // null: not asked for yet
};

/// The nodes of an arrangement: distinct points, numbered from 0 in order of first use, so that ids depend on nothing
/// but the order of the calls.
class NodePool {
 public:
  NodePool() = default;
  /// With capacity for `expected_count` nodes.
  explicit NodePool(std::size_t expected_count) : points_(expected_count) {}

  /// The node at the point, which is added if it is new. Cost: constant expected.
  NodeId intern(const PointRef& point) { return NodeId(points_.intern(point)); }

  /// Frees what finding points takes: no more are added.
  void finish() { points_.finish(); }

  PointRef operator[](NodeId node) const { return points_[node.index()]; }
  std::size_t size() const { return points_.size(); }
  IdRange<NodeId> ids() const { return IdRange<NodeId>(size()); }
  /// The points by the indices of their nodes.
  const PointTable& points() const { return points_; }

  /// The exact point half-way between two nodes.
  ExactPoint middle(NodeId a, NodeId b) const {
    return ExactPoint(Rational(1, 2) * ((*this)[a].rational() + (*this)[b].rational()));
  }

 private:
  PointTable points_;
};

/// A straight piece between two nodes: an edge of an operand that bounds a facet, or the common part of two facets, or
/// both. There is only one segment between two nodes, even if several edges and common parts run between them.
struct Segment {
  NodeId from, to;
  InputEdgeId edge;  ///< an edge of an operand from one end to the other; none if there is none
  /// The first two facets found that have the segment in common and lie in different planes, whether they cross there
  /// or one ends there; none if the segment is only an edge. SegmentComplex::incidences has all facets.
  FacetId first_facet, second_facet;
};

/// On which sides of a segment or sub-edge a facet of the same plane lies, for someone who walks along it and looks at
/// the front of the plane. `both`: the segment is inside the facet, or bounds it from both sides.
enum class FacetSides : std::uint8_t { both, left, right };

/// True if the facet lies on that side.
constexpr bool includes(FacetSides sides, Side side) {
  return sides != (side == Side::left ? FacetSides::right : FacetSides::left);
}

/// The sides with left and right exchanged, as seen when walking the other way.
constexpr FacetSides opposite(FacetSides sides) {
  constexpr std::array<FacetSides, 3> kOpposites{FacetSides::both, FacetSides::right, FacetSides::left};
  return kOpposites[static_cast<std::size_t>(sides)];
}

/// A segment and a facet that holds it. The sides are those for someone who walks from the segment's first end to the
/// second. (The incident facets of a sub-edge are in sub_edges.h.)
struct SegmentIncidence {
  SegmentId segment;
  FacetId facet;
  FacetSides sides;
};

/// A node inside a segment, at which the segment has to be cut.
struct Cut {
  SegmentId segment;
  NodeId node;

  friend auto operator<=>(const Cut&, const Cut&) = default;
};

/// A point contact: another facet touches this one at the node, in its inside or on its boundary. Stage 5 needs it,
/// where a segment of the plane may lead through the node.
struct Touch {
  FacetId facet;
  NodeId node;
};

/// Two segments that lie on one line and may overlap: where one is cut, so is the other.
struct CollinearSegments {
  SegmentId first, second;
};

/// The node at a vertex of an operand.
struct NodeOfVertex {
  InputVertexId vertex;
  NodeId node;
};

/// The segment complex (docs/set-operations.md, "Words"): all segments of an arrangement, before they are divided.
/// Output of stage 4 (find_facet_contacts) and of stage 5 (overlay), which adds cuts and nodes. A segment is one object
/// for all planes in which it lies, so a cut that one plane finds is there in all.
struct SegmentComplex {
  NodePool nodes;  ///< the ends of segments, and all points at which segments are cut or facets touch
  IdVector<SegmentId, Segment> segments;
  std::vector<SegmentIncidence> incidences;  ///< the facets that hold each segment, in no order
  /// In no order and with repetitions before the overlay, which sorts them. Cuts at the ends of a segment are allowed
  /// and mean nothing.
  std::vector<Cut> cuts;
  std::vector<Touch> touches;
  std::vector<CollinearSegments> collinear;
  /// The vertices of operands that are nodes, each once.
  std::vector<NodeOfVertex> nodes_of_vertices;
  PlaneCoefficients coefficients;  ///< of the planes that crossings were computed from

  /// Frees what only the stages up to the division into sub-edges need: incidences, cuts, touches, collinear segments.
  void free_divided() {
    std::vector<SegmentIncidence>().swap(incidences);
    std::vector<Cut>().swap(cuts);
    std::vector<Touch>().swap(touches);
    std::vector<CollinearSegments>().swap(collinear);
  }
  /// Frees the segments themselves, once uncut edges are known.
  void free_segments() { IdVector<SegmentId, Segment>().values().swap(segments.values()); }
  /// Notes that two segments lie on one line; does nothing if they are the same.
  void note_collinear(SegmentId a, SegmentId b) {
    if (a != b) collinear.push_back({a, b});
  }
};

/// The other plane of a common part: of the planes of its two facets the one that is not `plane`. The segment must be a
/// common part, and lie in `plane`. Used by stage 5.
PlaneId other_plane(const Facets& facets, const Segment& segment, PlaneId plane);

/// Every violated invariant, one sentence each: a segment is an edge or a common part, has the ends of its edge, and is
/// the only one between them; it lies in the planes of the facets that hold it; cuts lie on segments, touches in the
/// planes of facets; collinear segments are collinear; a vertex has one node, at its place.
/// Cost: n log n, with exact predicates.
std::vector<std::string> audit(const Operands& operands, const Facets& facets, const SegmentComplex& complex);

}  // namespace algebra3d::arrangement
