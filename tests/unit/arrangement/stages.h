#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/kernel/arrangement/detail/candidates.h"
#include "algebra3d/kernel/arrangement/detail/facet_contacts.h"
#include "algebra3d/kernel/arrangement/detail/facets.h"
#include "algebra3d/kernel/arrangement/detail/incident_facets.h"
#include "algebra3d/kernel/arrangement/detail/overlay.h"
#include "algebra3d/kernel/arrangement/detail/pair_contacts.h"
#include "algebra3d/kernel/arrangement/detail/patches.h"
#include "algebra3d/kernel/arrangement/detail/sub_edges.h"
#include "algebra3d/kernel/arrangement/detail/subdivision.h"
#include "unit/arrangement/solids.h"

/// The stages of an arrangement one by one, and their outputs as text: by places, not by ids, and sorted, so that an
/// expected output can be worked out by hand. Operand 0 is A, operand 1 is B.
///
/// A box has two faces on each side (solids.h): z- has the faces 0 and 1, z+ 2 and 3, y- 4 and 5, y+ 6 and 7, x- 8 and
/// 9, x+ 10 and 11.
namespace algebra3d::arrangement::stages {

using Lines = std::vector<std::string>;

inline Lines sorted(Lines lines) {
  std::ranges::sort(lines);
  return lines;
}

/// Two boxes, and what the stages make of them.
class Boxes {
 public:
  Boxes(const TriangleMesh& a, const TriangleMesh& b) : meshes_{a, b}, list_{{{&meshes_[0], 0}, {&meshes_[1], 1}}} {}
  Boxes(const Boxes&) = delete;
  Boxes& operator=(const Boxes&) = delete;

  std::array<Operand, 2>& list() { return list_; }
  const Operands& operands() const { return operands_; }
  Candidates candidates() const { return find_candidates(operands_, {}).value(); }
  PairContacts contacts() const { return find_pair_contacts(operands_, candidates(), {}).value(); }
  Facets facets() const { return make_facets(operands_, contacts()); }
  /// Before the overlay.
  SegmentComplex facet_contacts(const Facets& facets) const {
    return find_facet_contacts(operands_, facets, contacts()).value();
  }
  SegmentComplex overlaid(const Facets& facets) const {
    return overlay(operands_, facets, facet_contacts(facets), {}).value();
  }
  Subdivision subdivision() const { return subdivide(list_, Boundaries::none, {}, {}).value(); }

 private:
  std::array<TriangleMesh, 2> meshes_;
  std::array<Operand, 2> list_;
  Operands operands_{list_};
};

// The cases of the tests. Each is the smallest of its kind.

/// Corner (4 4 4) of A lies in B, and corner (2 2 2) of B in A.
struct CrossingCubes : Boxes {
  CrossingCubes() : Boxes(solids::cube(0, 4), solids::cube(2, 6)) {}
};
/// Side by side: the square x = 2 is a side of both.
struct SharedFace : Boxes {
  SharedFace() : Boxes(solids::cube(0, 2), solids::box({2, 0, 0}, {4, 2, 2})) {}
};
/// Corner to corner in the plane: the edge from (2 2 0) to (2 2 2) is one of both.
struct SharedEdge : Boxes {
  SharedEdge() : Boxes(solids::cube(0, 2), solids::box({2, 2, 0}, {4, 4, 2})) {}
};
/// The point (2 2 2) is a corner of both.
struct SharedVertex : Boxes {
  SharedVertex() : Boxes(solids::cube(0, 2), solids::cube(2, 4)) {}
};
/// B stands on A and reaches over two of its edges: in the plane z = 2, A has the square from (0 0) to (2 2), B that
/// from (1 1) to (3 3).
struct CoplanarOverlap : Boxes {
  CoplanarOverlap() : Boxes(solids::cube(0, 2), solids::box({1, 1, 2}, {3, 3, 4})) {}
};
/// B lies inside A and touches nothing.
struct Cavity : Boxes {
  Cavity() : Boxes(solids::cube(0, 6), solids::cube(2, 4)) {}
};

inline std::string text(const PointRef& point) {
  return fmt::format("({} {} {})", point.approx.x, point.approx.y, point.approx.z);
}
inline std::string text(const NodePool& nodes, NodeId node) {
  return text(nodes[node]);
}
inline char name(OperandId operand) {
  return static_cast<char>('A' + operand.index());
}
/// "A10": face 10 of operand A.
inline std::string text(const Operands& operands, InputFaceId face) {
  const OperandId operand = operands.operand_of(face);
  return fmt::format("{}{}", name(operand), operands.in_mesh(operand, face).index());
}
/// "x=4", for planes parallel to two axes.
inline std::string text(const Plane& plane) {
  const auto& [a, b, c] = plane.triangle();
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (a.approx[axis] == b.approx[axis] && b.approx[axis] == c.approx[axis])
      return fmt::format("{}={}", "xyz"[axis], a.approx[axis]);
  return "oblique";
}
/// "A x=4": the facet of A in this plane. No operand of these tests has two.
inline std::string text(const Facets& facets, FacetId facet) {
  return fmt::format("{} {}", name(facets[facet].operand), text(facets.plane_of(facet)));
}
/// The ends in lexicographic order: "(0 0 4)-(4 0 4)".
inline std::string line(const NodePool& nodes, NodeId a, NodeId b) {
  const std::string from = text(nodes, a), to = text(nodes, b);
  return from < to ? from + "-" + to : to + "-" + from;
}

inline Lines text(const Operands& operands, const Candidates& candidates) {
  Lines lines;
  for (const auto& [first, second] : candidates.pairs)
    lines.push_back(text(operands, first) + " " + text(operands, second));
  return sorted(std::move(lines));
}

/// "z=2: A front 2 3, B back 0 1".
inline Lines text(const Operands& operands, const Facets& facets) {
  Lines lines;
  for (const PlaneId plane : facets.planes.ids()) {
    Lines in_plane;
    for (const Facet& facet : facets.facets) {
      if (facet.plane != plane) continue;
      std::vector<std::uint32_t> faces;
      for (const InputFaceId face : facet.faces.of(facets.faces))
        faces.push_back(operands.in_mesh(facet.operand, face).index());
      std::ranges::sort(faces);
      in_plane.push_back(fmt::format("{} {} {}", name(facet.operand), facet.orientation > 0 ? "front" : "back",
                                     fmt::join(faces, " ")));
    }
    lines.push_back(fmt::format("{}: {}", text(facets.planes[plane]), fmt::join(sorted(in_plane), ", ")));
  }
  return sorted(std::move(lines));
}

/// "(0 0 4)-(4 0 4): A z=4 edge": each segment with the facets that it bounds (edge) or crosses (inside).
inline Lines segments(const Facets& facets, const SegmentComplex& complex) {
  Lines lines;
  for (const SegmentId segment : complex.segments.ids()) {
    Lines holders;
    for (const SegmentIncidence& incidence : complex.incidences)
      if (incidence.segment == segment)
        holders.push_back(text(facets, incidence.facet) + (incidence.sides == FacetSides::both ? " inside" : " edge"));
    lines.push_back(fmt::format("{}: {}",
                                line(complex.nodes, complex.segments[segment].from, complex.segments[segment].to),
                                fmt::join(sorted(holders), ", ")));
  }
  return sorted(std::move(lines));
}

/// "(4 0 4)-(4 4 4) at (4 2 4)": each cut that is not an end of its segment, once.
inline Lines cuts(const SegmentComplex& complex) {
  Lines lines;
  for (const auto& [id, node] : complex.cuts) {
    const Segment& segment = complex.segments[id];
    if (node == segment.from || node == segment.to) continue;
    lines.push_back(line(complex.nodes, segment.from, segment.to) + " at " + text(complex.nodes, node));
  }
  std::ranges::sort(lines);
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

/// "A x=2 at (2 1 2)": each touch, once.
inline Lines touches(const Facets& facets, const SegmentComplex& complex) {
  Lines lines;
  for (const auto& [facet, node] : complex.touches)
    lines.push_back(text(facets, facet) + " at " + text(complex.nodes, node));
  std::ranges::sort(lines);
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

}  // namespace algebra3d::arrangement::stages
