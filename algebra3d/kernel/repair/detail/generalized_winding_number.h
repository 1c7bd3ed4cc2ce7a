#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/strong_id.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "base/id_vector.h"

namespace algebra3d {

/// Computes generalized winding numbers: the sum of the signed solid angles of triangles, which need not be closed, as
/// seen from a point, divided by 4 pi. Close to an integer for nearly closed triangles. Rounded.
///
/// From outside the box of some triangles these are seen under the same angle as any other surface within the box that
/// ends at the same edges, such as the cone over their boundary. So a tree of triangles keeps the boundary of each
/// part, and most parts are replaced by their cones. Source: [jacobson2013], section 4.2; [vanoosterom1983].
class GeneralizedWindingNumbers {
 public:
  /// The soup must outlive this. Cost: n log n.
  explicit GeneralizedWindingNumbers(const IndexedSoup& soup);

  /// Cost: about the square root of the number of triangles, where they are nearly closed; linear at most.
  double at(const Vec3& point) const;
  /// The number of solid angles that `at` has summed up since the construction.
  std::size_t angle_count() const { return angle_count_; }

 private:
  /// An edge of the boundary of a part, that many times.
  struct BoundaryEdge {
    VertexId from, to;  // from < to
    int count;          // negative: the other way
  };
  using Boundary = std::vector<BoundaryEdge>;
  /// A part of the triangles. Its children follow it.
  struct Part {
    Box3 box;
    std::size_t begin, end;                            // of its triangles in order_
    std::size_t boundary_begin = 0, boundary_end = 0;  // in boundaries_
    bool has_cone = false;                             // it has fewer triangles than the part
    std::size_t behind = 0;                            // the first part that is not within it
  };

  void find_components();
  std::size_t halve(std::span<FaceId> triangles, std::size_t axis) const;
  Boundary add_part(std::size_t begin, std::size_t end);
  Boundary boundary_of(std::span<const FaceId> triangles) const;
  class AngleSum;

  void add_half_angle(VertexId i, VertexId j, VertexId k, const Vec3& point, int count, AngleSum& sum) const;
  void add_triangles(const Part& part, const Vec3& point, AngleSum& sum) const;
  void add_cone(const Part& part, const Vec3& point, AngleSum& sum) const;

  using ComponentId = StrongId<struct WindingComponentTag>;

  const IndexedSoup& soup_;
  IdVector<FaceId, ComponentId> component_of_;
  IdVector<ComponentId, Vec3> middles_;  // of the boxes around components
  std::vector<FaceId> order_;
  std::vector<Part> parts_;
  Boundary boundaries_;
  mutable std::size_t angle_count_ = 0;
};

}  // namespace algebra3d
