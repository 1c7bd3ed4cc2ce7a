#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/rounding/detail/triangle_stars.h"

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

  /// Prepares the questions below.
  void measure(const TriangleStars& stars, double tolerance);
  /// True if the vertex is certainly farther than the tolerance from the plane of one of the triangles that replace the
  /// fan if the vertex is merged with this neighbour, which is given by its place in the ring. Decided in doubles with
  /// an error bound. Cost: linear; constant in most cases where the answer is true.
  bool bends(std::size_t target);
  /// The least height of these triangles; 0 if they do not represent the surface: if one is turned over or farther than
  /// the tolerance from the vertex, or if the vertex is over none of them. Nothing if doubles cannot decide it.
  std::optional<double> least_height(std::size_t target) const;

 private:
  /// A triangle of the fan, between a neighbour and the next. It and another neighbour span a tetrahedron of six times
  /// the volume |normal * spoke|, with an error that the magnitude bounds.
  struct Sector {
    Vec3 normal, magnitude;   ///< the product of both spokes; with all signs positive
    double fixed, per_reach;  ///< a height of the new triangle by its base: at most fixed + per_reach * |spoke|
  };

  std::size_t next(std::size_t i) const { return i + 1 == ring_.size() ? 0 : i + 1; }
  /// True if sector i goes if the vertex is merged with the target.
  bool is_at(std::size_t i, std::size_t target) const { return i == target || next(i) == target; }
  double volume_error(const Sector& sector, const Vec3& spoke) const;

  double tolerance_ = 0;
  std::uint32_t vertex_ = 0;
  std::vector<std::uint32_t> ring_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides_;  // opposite to the vertex, as they come
  std::vector<std::uint32_t> sorted_;
  std::vector<Vec3> places_, spokes_;  // of the ring
  std::vector<Sector> sectors_;        // one between each neighbour and the next
  std::size_t last_bent_ = 0;          // the sector that decided last
};

}  // namespace algebra3d
