#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "base/indices.h"
#include "base/wide_vec3.h"

namespace algebra3d::distances {

/// The coplanar facets of many triangles of a mesh, with their planes and outlines. A part of a triangle that lies over
/// the inside of such a facet is no farther from it than its corners are from the plane, however the facet is divided
/// into triangles. Refers to the mesh. Immutable.
class LargeFacets {
 public:
  /// The plane of a facet, rounded, in units: halved coordinates times `half_scale`, below 2.
  struct Plane {
    WideVec3 point;             ///< a vertex of the facet
    WideVec3 normal;            ///< of length 1
    long double deviation = 0;  ///< a bound of the distance of vertices from the rounded plane
    long double turn = 0;       ///< a bound of the angle between the normal and the exact one, below 2^-20
  };

  /// None.
  LargeFacets() = default;
  /// Coplanarity is exact; triangles that are degenerate but for roundings are in no facet. Cost: an orient3d for each
  /// edge, linear for the rest.
  LargeFacets(const TriangleMesh& mesh, double half_scale);

  /// The plane of the facet of a face; null if it has few triangles, or if the plane is not known well.
  const Plane* plane_of(FaceId face) const {
    const std::uint32_t facet = facet_of(face);
    return facet == kNone ? nullptr : &planes_[facet];
  }

  /// Calls visit(a, b) for the ends of each edge in the outline of the facet of a face, if the edge may meet the box,
  /// until it returns false.
  template <typename Visit>
  void for_each_outline_edge(FaceId face, const Box3& box, Visit visit) const {
    if (!hierarchy_) return;
    hierarchy_->for_each_meeting(box, [&](std::uint32_t edge) {
      if (facet_of_edge_[edge] != facet_of(face)) return true;
      const auto [a, b, same] = outlines_.triangle(FaceId(edge));
      return visit(outlines_.points().approx()[a], outlines_.points().approx()[b]);
    });
  }

 private:
  std::uint32_t facet_of(FaceId face) const { return facet_of_face_.empty() ? kNone : facet_of_face_[face.index()]; }
  void find_facets(const TriangleMesh& mesh, double half_scale);
  void find_planes(const TriangleMesh& mesh, double half_scale);
  void find_outlines(const TriangleMesh& mesh);

  std::vector<std::uint32_t> facet_of_face_;  // empty without large facets
  std::vector<Plane> planes_;
  TriangleMesh outlines_;  // a face with a repeated corner for each edge
  std::vector<std::uint32_t> facet_of_edge_;
  std::optional<BoxHierarchy> hierarchy_;  // over the outlines
};

}  // namespace algebra3d::distances
