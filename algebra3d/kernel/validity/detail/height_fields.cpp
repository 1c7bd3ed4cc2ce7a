// Why the boundary of a region is enough.
//
// The triangles of a region, projected along its direction, turn counter-clockwise. The number of them that cover a
// point, off all their edges, is the sum of their winding numbers; edges between two triangles of the region cancel, so
// it is the winding number of the boundary. If that is at most 1 everywhere, no two projections have common inner
// points. If two triangles had a segment in common, its projection would lie in an edge of each. Were one of these
// edges inside the region, its other triangle would cover the same points as the second triangle does, so it would be
// that, and the segment would be their common edge. And two edges of the boundary have no segment in common.

#include "algebra3d/kernel/validity/detail/height_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra3d/kernel/validity/detail/simple_boundary.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

constexpr std::size_t kFacesPerTask = 4096;
/// The least cosine of the angle between the normal of a face and the direction of its region.
constexpr double kLeastCosine = 0.25;

/// A set of directions: bit 2 * axis, or 2 * axis + 1 for the negative direction.
using DirectionBits = std::uint8_t;

/// The normal of a triangle of doubles, rounded.
struct Normal {
  Vec3 value;
  double error = 0;  // of each coordinate, at most
};

inline Normal normal_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a;
  const double longest = std::max(detail::largest(u), detail::largest(v)), square = longest * longest;
  // Two products of at most longest^2, each with three roundings of 2^-53, and the rounding of their difference.
  // Outside this range underflow would break the bound, or overflow make it void.
  const bool is_in_range = square > 1e-250 && square < 1e250;
  return {cross(u, v), is_in_range ? 2e-15 * square : std::numeric_limits<double>::infinity()};
}

/// The directions in which the front of a triangle is seen well.
inline DirectionBits directions_of(const Normal& normal) {
  const double least = std::max(normal.error, kLeastCosine * std::sqrt(dot(normal.value, normal.value)));
  unsigned bits = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    bits |= static_cast<unsigned>(normal.value[axis] > least) << (2 * axis);
    bits |= static_cast<unsigned>(normal.value[axis] < -least) << (2 * axis + 1);
  }
  return static_cast<DirectionBits>(bits);
}

/// The number of the direction in which the front is seen best.
unsigned best_direction(const Normal& normal) {
  unsigned best = 0;
  for (unsigned axis = 1; axis < 3; ++axis)
    if (std::abs(normal.value[axis]) > std::abs(normal.value[best])) best = axis;
  return 2 * best + (normal.value[best] < 0 ? 1 : 0);
}

class RegionGrowing {
 public:
  explicit RegionGrowing(const TriangleMesh& mesh) : mesh_(mesh), directions_(mesh.face_count()) {
    parallel_for(mesh.face_count(), kFacesPerTask, [&](std::size_t f) {
      if (has_double_corners(FaceId(f))) directions_[FaceId(f)] = directions_of(rounded_normal(FaceId(f)));
    });
  }

  FacingRegions run() {
    found_.of_face.resize(mesh_.face_count());
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f)
      if (found_.of_face[FaceId(f)].is_none()) grow(FaceId(f));
    return std::move(found_);
  }

 private:
  bool has_double_corners(FaceId face) const {
    if (mesh_.points().exact_count() == 0) return true;
    return std::ranges::all_of(mesh_.corners(face), [](const PointRef& corner) { return corner.is_double(); });
  }
  Normal rounded_normal(FaceId face) const {
    const std::vector<Vec3>& points = mesh_.points().approx();
    const TriangleMesh::Triangle t = mesh_.triangle(face);
    return normal_of(points[t[0]], points[t[1]], points[t[2]]);
  }
  void grow(FaceId seed) {
    const RegionId region = found_.regions.push_back({{}, seed, 1});
    found_.of_face[seed] = region;
    const unsigned number = best_direction(rounded_normal(seed));
    const auto bit = static_cast<DirectionBits>(1U << number);
    if ((directions_[seed] & bit) == 0) return;
    FacingRegion& grown = found_.regions[region];
    grown.direction = {static_cast<Projection>(number / 2), number % 2 != 0};
    stack_.push_back(seed);
    while (!stack_.empty()) {
      const FaceId face = stack_.back();
      stack_.pop_back();
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const HalfedgeId opposite = mesh_.opposite(TriangleMesh::halfedge(face, corner));
        if (!opposite.is_valid()) continue;
        const FaceId next = TriangleMesh::face(opposite);
        if ((directions_[next] & bit) == 0 || !found_.of_face[next].is_none()) continue;
        found_.of_face[next] = region;
        stack_.push_back(next);
        ++grown.face_count;
      }
    }
  }

  const TriangleMesh& mesh_;
  IdVector<FaceId, DirectionBits> directions_;  // in which the front of each face is seen well
  FacingRegions found_;
  std::vector<FaceId> stack_;
};

/// Grows regions from the lowest faces that are in none, as far as the front is seen at an angle that is not too
/// narrow. Cost: linear, some 15 ns per face.
FacingRegions find_facing_regions(const TriangleMesh& mesh) {
  return RegionGrowing(mesh).run();
}

constexpr std::size_t kFacesPerRange = 8192;
constexpr std::size_t kRegionsPerTask = 16;
/// One triangle does not overlap itself, nor do two that lie on both sides of their common edge.
constexpr std::uint32_t kProvedFaces = 2;

Vec3 projected(const Vec3& point, Projection projection) {
  return {point[first_axis(projection)], point[second_axis(projection)], 0};
}

/// The projected half-edge, with the region to its left.
PlanarEdge projected_edge(const TriangleMesh& mesh, HalfedgeId h, AxisDirection direction) {
  const std::vector<Vec3>& points = mesh.points().approx();
  const Vec3 from = projected(points[mesh.origin(h).index()], direction.projection),
             to = projected(points[mesh.target(h).index()], direction.projection);
  return direction.is_negative ? PlanarEdge{to, from} : PlanarEdge{from, to};
}

/// The border half-edges of each region of more than kProvedFaces.
class RegionBorders {
 public:
  RegionBorders(const FacingRegions& regions, const std::vector<HalfedgeId>& borders)
      : starts_(regions.regions.size() + 1) {
    const auto region_of = [&](HalfedgeId h) { return regions.of_face[TriangleMesh::face(h)]; };
    for (const HalfedgeId h : borders) ++starts_[region_of(h).index() + 1];
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    std::vector<std::uint32_t> places(starts_.begin(), starts_.end() - 1);
    sorted_.resize(borders.size());
    for (const HalfedgeId h : borders) sorted_[places[region_of(h).index()]++] = h;
  }

  std::span<const HalfedgeId> operator[](RegionId region) const {
    const std::uint32_t start = starts_[region.index()];
    return std::span(sorted_).subspan(start, starts_[region.index() + 1] - start);
  }

 private:
  std::vector<std::uint32_t> starts_;
  std::vector<HalfedgeId> sorted_;
};

bool is_height_field(const TriangleMesh& mesh, const FacingRegion& region, std::span<const HalfedgeId> border) {
  if (!region.direction) return false;
  if (region.face_count <= kProvedFaces) return true;
  std::vector<PlanarEdge> edges;
  edges.reserve(border.size());
  for (const HalfedgeId h : border) edges.push_back(projected_edge(mesh, h, *region.direction));
  return bounds_simple_region(edges);
}

}  // namespace

HeightFields::HeightFields(const TriangleMesh& mesh)
    : regions_(find_facing_regions(mesh)), is_field_(regions_.regions.size()), are_inside_(mesh.vertex_count(), 1) {
  find_borders(mesh);
  prove_regions(mesh);
  find_inner_vertices(mesh);
}

void HeightFields::find_borders(const TriangleMesh& mesh) {
  borders_ = parallel_collect(mesh.face_count(), kFacesPerRange, [&](std::size_t begin, std::size_t end) {
    std::vector<HalfedgeId> borders;
    for (std::size_t f = begin; f < end; ++f) {
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const HalfedgeId h = TriangleMesh::halfedge(FaceId(f), corner), opposite = mesh.opposite(h);
        if (!opposite.is_valid() || regions_.of_face[TriangleMesh::face(opposite)] != regions_.of_face[FaceId(f)])
          borders.push_back(h);
      }
    }
    return borders;
  });
}

void HeightFields::prove_regions(const TriangleMesh& mesh) {
  const RegionBorders borders(regions_, borders_);
  parallel_for(regions_.regions.size(), kRegionsPerTask, [&](std::size_t i) {
    const RegionId region(i);
    is_field_[region] = static_cast<std::uint8_t>(is_height_field(mesh, regions_.regions[region], borders[region]));
  });
}

void HeightFields::find_inner_vertices(const TriangleMesh& mesh) {
  const auto exclude = [&](VertexId vertex) { are_inside_[vertex.index()] = 0; };
  for (const HalfedgeId h : borders_) {
    exclude(mesh.origin(h));
    exclude(mesh.target(h));
  }
  // Its fans may be in different fields.
  std::ranges::for_each(mesh.nonmanifold_vertices(), exclude);
  if (std::ranges::find(is_field_, 0) == is_field_.end()) return;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    if (field(FaceId(f)).is_none())
      for (const std::uint32_t corner : mesh.triangle(FaceId(f))) exclude(VertexId(corner));
}

}  // namespace algebra3d
