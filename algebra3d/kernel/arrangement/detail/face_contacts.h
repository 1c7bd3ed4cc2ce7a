#pragma once

#include <array>
#include <compare>
#include <optional>
#include <tuple>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/facets.h"
#include "algebra3d/kernel/arrangement/detail/pair_contacts.h"

namespace algebra3d::arrangement {

/// Queries about the boundaries of facets: whether edges and vertices of faces are on them.
class FacetBoundaries {
 public:
  FacetBoundaries(const Operands& operands, const Facets& facets) : operands_(operands), facets_(facets) {}

  /// True unless the faces on both sides of the edge are of one facet. The half-edge's face must be in a facet.
  bool has_edge(InputHalfedgeId halfedge) const { return facets_.is_boundary(operands_, halfedge); }
  /// True if the origin of the half-edge is on the boundary of the facet of its face, false if it is inside that facet.
  /// The face must be in a facet.
  bool has_origin(InputHalfedgeId halfedge);

 private:
  enum class Known : std::uint8_t { nothing, inside, boundary };

  bool finds_boundary_at_origin(InputHalfedgeId halfedge) const;

  const Operands& operands_;
  const Facets& facets_;
  IdVector<InputHalfedgeId, Known> origins_;  // empty until one is asked for: solids in general position ask for none
};

/// The smallest part of an operand that holds a point, named so that all faces round it give the same name: a vertex,
/// an edge, or a facet. So two pairs of faces that see the same end of a common part are recognised without computing
/// the point.
class Feature {
 public:
  Feature() = default;
  explicit Feature(InputVertexId vertex) : Feature(Place::Kind::corner, vertex.index()) {}
  explicit Feature(InputEdgeId edge) : Feature(Place::Kind::edge, edge.index()) {}
  explicit Feature(FacetId facet) : Feature(Place::Kind::inside, facet.index()) {}

  bool is_vertex() const { return kind_ == Place::Kind::corner; }
  bool is_edge() const { return kind_ == Place::Kind::edge; }
  /// The edge. Only if the feature is one.
  InputEdgeId edge() const { return InputEdgeId(index_); }

  friend auto operator<=>(const Feature&, const Feature&) = default;

 private:
  Feature(Place::Kind kind, std::uint32_t index) : kind_(kind), index_(index) {}

  Place::Kind kind_ = Place::Kind::inside;
  std::uint32_t index_ = 0;
};

/// A point that two facets have in common, by the feature of each on which it lies: the same for all pairs of faces
/// that have the point.
struct FeaturePair {
  Feature first, second;

  friend auto operator<=>(const FeaturePair&, const FeaturePair&) = default;
};

/// An end of a common part as one of the two faces sees it.
struct EndInFace {
  InputHalfedgeId halfedge;  ///< from the corner or along the edge where the end is; if it is inside the face any one
  bool runs_along;           ///< as in ContactPoint
};

/// An end of the common part of two faces.
struct FaceContactEnd {
  FeaturePair features;
  EndInFace first, second;
};

/// The common part of two faces that are not coplanar; a point if both ends are the same.
struct FaceContact {
  FacetId first_facet, second_facet;
  std::array<FaceContactEnd, 2> ends;  ///< ascending by features
  /// The half-edge of each face that lies in the plane of the other one; none if there is none.
  InputHalfedgeId first_edge, second_edge;

  auto key() const { return std::tie(first_facet, second_facet, ends[0].features, ends[1].features); }
  bool is_point() const { return ends[0].features == ends[1].features; }
};

/// The contact of two faces by features; nothing if nothing is divided there. That is so of two corners, both on the
/// boundaries of their facets, that touch in a point: both are ends of segments already. It is also so of coplanar
/// faces: the boundaries of their facets are segments of one plane, which stage 5 (overlay.h) divides at one another.
std::optional<FaceContact> face_contact(const PairContact& pair, const Operands& operands, const Facets& facets,
                                        FacetBoundaries& boundaries);

}  // namespace algebra3d::arrangement
