#include "algebra3d/arrangement/detail/regions.h"

#include <algorithm>
#include <optional>
#include <span>

#include "algebra3d/base/scheduler.h"
#include "algebra3d/planar/sweep_triangulation.h"

namespace algebra3d::arrangement {
namespace {

constexpr std::size_t kRegionsPerTask = 32;

using Boundary = std::span<const RegionEdge>;

/// The edges of each region. They are ascending.
std::vector<Boundary> boundaries_of_regions(const std::vector<RegionEdge>& edges) {
  std::vector<Boundary> boundaries;
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].region == edges[begin].region) ++end;
    boundaries.push_back(std::span(edges).subspan(begin, end - begin));
  }
  return boundaries;
}

/// Nothing if the edges bound no region.
std::optional<Region> triangulated(const Subdivision& subdivision, Boundary boundary) {
  const NodePool& nodes = subdivision.complex.nodes;
  Region region{boundary.front().region, false, {}};
  std::vector<DirectedEdge> edges;
  edges.reserve(boundary.size());
  for (const auto& [key, from, to] : boundary) {
    edges.emplace_back(from.index(), to.index());
    region.has_exact_corner = region.has_exact_corner || !nodes[from].is_double();
  }
  region.triangles.reserve(edges.size());
  const Projection projection = subdivision.facets.planes[region.key.plane].projection;
  if (!triangulate_by_sweep(nodes.points(), projection, edges, region.triangles)) return std::nullopt;
  return region;
}

Error unbounded_region(const Subdivision& subdivision, const RegionKey& region) {
  const Facets& facets = subdivision.facets;
  const auto facet = std::ranges::find(facets.facets, region.plane, &Facet::plane);
  const InputFaceId face = facets.faces[facet->faces.first];
  const Vec3 where = subdivision.operands.corners(face)[0].approx;
  return {ErrorCode::internal,
          "building the result of a set operation: the edges in the plane of triangle {} of operand {}, near ({} {} "
          "{}), do not bound a face all round",
          subdivision.operands.in_mesh(facet->operand, face).index(),
          facet->operand.index(),
          where.x,
          where.y,
          where.z};
}

}  // namespace

Result<std::vector<Region>> triangulate_regions(const Subdivision& subdivision, const std::vector<RegionEdge>& edges) {
  const std::vector<Boundary> boundaries = boundaries_of_regions(edges);
  std::vector<std::optional<Region>> found(boundaries.size());
  parallel_for(boundaries.size(), kRegionsPerTask,
               [&](std::size_t i) { found[i] = triangulated(subdivision, boundaries[i]); });
  std::vector<Region> regions;
  regions.reserve(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i]) return unbounded_region(subdivision, boundaries[i].front().region);
    regions.push_back(*std::move(found[i]));
  }
  return regions;
}

}  // namespace algebra3d::arrangement
