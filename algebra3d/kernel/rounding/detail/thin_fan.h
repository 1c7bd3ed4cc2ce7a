#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "algebra3d/kernel/rounding/detail/triangle_stars.h"
#include "algebra3d/kernel/rounding/detail/vertex_fan.h"
#include "base/wide_vec3.h"

namespace algebra3d {

/// The fan of a vertex that may contain thin triangles, of a height of at most two tolerances, whose orientation is
/// ignored. Computed in long doubles.
class ThinFan {
 public:
  /// Takes over a fan. The tolerance is in coordinate units.
  ThinFan(const TriangleStars& stars, const VertexFan& fan, long double tolerance);

  /// The least height of the triangles that replace the fan if the vertex is merged with this neighbour, which is given
  /// by its place in the ring. Nothing if they do not represent the surface: if the vertex is not within the tolerance
  /// of them, or if one that is not thin faces the other way than those that it replaces.
  std::optional<long double> least_height(std::size_t target) const;

 private:
  struct Triangle {
    WideVec3 normal;  // twice as long as the area
    long double height;
  };
  Triangle triangle(const WideVec3& apex, std::size_t side) const;
  bool is_thin(const Triangle& t) const { return t.height <= 2 * tolerance_; }
  bool is_replacement(const Triangle& t, std::size_t side, const WideVec3& target) const;
  bool faces_like_neighbours(const Triangle& t, std::size_t side) const;
  bool is_next_to_vertex(const Triangle& t, std::size_t side, const WideVec3& target) const;
  std::size_t next(std::size_t i) const { return i + 1 == ring_.size() ? 0 : i + 1; }

  long double tolerance_;
  std::vector<WideVec3> ring_;       // the vertex is the origin
  std::vector<Triangle> triangles_;  // between each neighbour and the next
};

}  // namespace algebra3d
