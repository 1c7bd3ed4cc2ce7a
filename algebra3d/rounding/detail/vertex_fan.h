#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/rounding/detail/triangle_stars.h"

namespace algebra3d {

/// The triangles around a vertex as one closed fan. To be used again for one vertex after the other, so that no memory
/// is allocated for each.
class VertexFan {
 public:
  /// Takes the triangles that are at the vertex now. Returns false if they do not form one closed fan with different
  /// neighbours, or if these are more than `most_neighbours`. Cost: linear where the triangles come in their order, as
  /// in the original mesh, and quadratic at most.
  bool surround(const TriangleStars& stars, std::uint32_t vertex, std::size_t most_neighbours);

  std::uint32_t vertex() const { return vertex_; }
  /// The neighbours in their order, counterclockwise seen from outside.
  const std::vector<std::uint32_t>& ring() const { return ring_; }

  /// How much the triangles of the fan bend, for bends(): to be computed once.
  void measure(const TriangleStars& stars, double tolerance);
  /// True if the vertex is certainly farther than the tolerance from the plane of one of the triangles that replace the
  /// fan if the vertex is merged with this neighbour, which is given by its place in the ring. By doubles with a bound
  /// of their error. Cost: linear, and a constant for most that bend.
  bool bends(std::size_t target);

 private:
  /// Four times the volume of the tetrahedron of vertex, side and target is |normal * spoke|.
  struct Sector {
    Vec3 normal;              ///< of the triangle, by the length of its sides
    double fixed, per_reach;  ///< bound of what may be: fixed + per_reach * |spoke|
  };

  std::uint32_t vertex_ = 0;
  std::vector<std::uint32_t> ring_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides_;  // opposite to the vertex, as they come
  std::vector<std::uint32_t> sorted_;
  std::vector<Vec3> spokes_;
  std::vector<Sector> sectors_;  // one between each neighbour and the next
  std::size_t last_bent_ = 0;    // the sector that decided last
};

}  // namespace algebra3d
