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

#include "algebra3d/kernel/validity/detail/simple_boundary.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

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
