#include "algebra3d/kernel/arrangement/detail/regions.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "algebra3d/kernel/planar/sweep_triangulation.h"
#include "base/scheduler.h"

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

/// Triangulates some of the regions.
class RegionTriangulator {
 public:
  RegionTriangulator(const Subdivision& subdivision, std::size_t region_count, std::size_t edge_count)
      : subdivision_(subdivision) {
    result_.regions.reserve(region_count);
    result_.triangles.reserve(edge_count);  // hardly any region has more triangles than edges
  }

  /// False if the edges bound no region.
  bool add(Boundary boundary);
  Regions take() { return std::move(result_); }

 private:
  const Subdivision& subdivision_;
  Regions result_;
  // Edges and triangles of the region at hand; members, so that their memory is used again.
  std::vector<DirectedEdge> edges_;
  std::vector<IndexTriangle> triangles_;
};

bool RegionTriangulator::add(Boundary boundary) {
  const NodePool& nodes = subdivision_.complex.nodes;
  bool has_exact_corner = false;
  edges_.clear();
  triangles_.clear();
  for (const auto& [key, from, to] : boundary) {
    edges_.emplace_back(from.index(), to.index());
    has_exact_corner = has_exact_corner || !nodes[from].is_double();
  }
  const RegionKey key = boundary.front().region;
  const Projection projection = subdivision_.facets.planes[key.plane()].projection;
  if (!triangulate_by_sweep(nodes.points(), projection, edges_, triangles_)) return false;
  const std::size_t first = result_.triangles.size();
  result_.triangles.insert(result_.triangles.end(), triangles_.begin(), triangles_.end());
  result_.regions.push_back({key, has_exact_corner, Slice::from(first, result_.triangles)});
  return true;
}

/// The regions of one task.
struct Part {
  Regions regions;
  std::optional<RegionKey> unbounded;  // one whose edges bound no region: later ones are not there
};

/// Consecutive regions, at least one.
Part triangulated(const Subdivision& subdivision, std::span<const Boundary> boundaries) {
  const auto edge_count =
      static_cast<std::size_t>(boundaries.back().data() + boundaries.back().size() - boundaries.front().data());
  RegionTriangulator triangulator(subdivision, boundaries.size(), edge_count);
  Part part;
  for (const Boundary& boundary : boundaries)
    if (!part.unbounded && !triangulator.add(boundary)) part.unbounded = boundary.front().region;
  part.regions = triangulator.take();
  return part;
}

/// Frees the parts.
Regions joined(std::vector<Part>& parts) {
  std::size_t region_count = 0, triangle_count = 0;
  for (const auto& [regions, unbounded] : parts) {
    region_count += regions.regions.size();
    triangle_count += regions.triangles.size();
  }
  Regions all;
  all.regions.reserve(region_count);
  all.triangles.reserve(triangle_count);
  for (Part& part : parts) {
    const Regions regions = std::move(part.regions);
    const std::size_t first = all.triangles.size();
    for (const auto& [key, has_exact_corner, triangles] : regions.regions)
      all.regions.push_back({key, has_exact_corner, Slice::between(first + triangles.first, first + triangles.last)});
    all.triangles.insert(all.triangles.end(), regions.triangles.begin(), regions.triangles.end());
  }
  return all;
}

Error unbounded_region(const Subdivision& subdivision, const RegionKey& region) {
  const Facets& facets = subdivision.facets;
  const auto facet = std::ranges::find(facets.facets, region.plane(), &Facet::plane);
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

Result<Regions> triangulate_regions(const Subdivision& subdivision, const std::vector<RegionEdge>& edges) {
  const std::vector<Boundary> boundaries = boundaries_of_regions(edges);
  std::vector<Part> parts =
      parallel_collect(boundaries.size(), kRegionsPerTask, [&](std::size_t begin, std::size_t end) {
        std::vector<Part> part;
        if (begin < end) part.push_back(triangulated(subdivision, std::span(boundaries).subspan(begin, end - begin)));
        return part;
      });
  for (const Part& part : parts)
    if (part.unbounded) return unbounded_region(subdivision, *part.unbounded);
  return joined(parts);
}

}  // namespace algebra3d::arrangement
