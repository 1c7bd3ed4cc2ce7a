#include "algebra3d/repair/rims.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/exact/predicates.h"
#include "algebra3d/repair/convex_polygon.h"
#include "algebra3d/repair/lacking_edges.h"
#include "algebra3d/repair/loop_triangulation.h"

namespace algebra3d {
namespace {

class RimCloser {
 public:
  RimCloser(FacetList& facets, const RimLimits& limits, RepairReport& report)
      : facets_(facets), limits_(limits), report_(report), lacks_(*facets.mesh()) {
    if (limits.takes_shortcuts) lacks_.add_chords(*facets.mesh());
  }

  Status run(const Monitor& monitor);

 private:
  struct Cover {
    HoleCover report;
    std::vector<TriangleMesh::Triangle> triangles;
    double area = 0;
  };

  std::vector<std::uint32_t> loop_from(std::uint32_t start) const;
  Cover cover_of(const std::vector<std::uint32_t>& loop) const;
  void add(Cover cover);

  FacetList& facets_;
  RimLimits limits_;
  RepairReport& report_;
  LackingEdges lacks_;
};

/// No triangles if the loop is too large, or lies on one line: then it closes by itself.
RimCloser::Cover RimCloser::cover_of(const std::vector<std::uint32_t>& loop) const {
  Box3 box;
  Loop corners;
  Cover result;
  for (const std::uint32_t i : loop) {
    corners.corners.push_back(facets_.points[lacks_.edges[i].from]);
    box.extend(corners.corners.back());
  }
  corners.beyond = corners.corners;
  const double diameter = length(box.max - box.min);
  result.report = {corners.corners[0], diameter, {}};
  if (diameter > limits_.largest) return result;
  for (const auto& [a, b, c] : triangulate_loop(corners, LoopMeasure::area)) {
    if (collinear(corners.corners[a], corners.corners[b], corners.corners[c])) continue;
    result.triangles.push_back({lacks_.edges[loop[a]].from, lacks_.edges[loop[b]].from, lacks_.edges[loop[c]].from});
    result.report.triangles.push_back({corners.corners[a], corners.corners[b], corners.corners[c]});
    result.area += area_of(result.report.triangles.back());
  }
  return result;
}

void RimCloser::add(Cover cover) {
  if (cover.triangles.empty()) return;
  facets_.triangles.insert(facets_.triangles.end(), cover.triangles.begin(), cover.triangles.end());
  facets_.changed();
  report_.add(std::move(cover.report));
}

/// The shortest one; or that along the boundaries alone, if it is smaller, as that of a gap between a cap that hangs on
/// an inner wall and what it should lie upon.
std::vector<std::uint32_t> RimCloser::loop_from(std::uint32_t start) const {
  std::vector<std::uint32_t> shortest = lacks_.shortest_loop(start, facets_.points);
  if (!lacks_.edges[start].ends_at_wall) return shortest;
  std::vector<std::uint32_t> along = lacks_.shortest_loop(start, facets_.points, LackingEdges::Way::boundary);
  if (along.size() < 3 || along == shortest) return shortest;
  const bool is_smaller = shortest.size() < 3 || cover_of(along).area < cover_of(shortest).area;
  return is_smaller ? along : shortest;
}

Status RimCloser::run(const Monitor& monitor) {
  if (!lacks_.has_others || !(lacks_.has_boundary || limits_.covers_walls)) return {};
  for (std::uint32_t start = 0; start < lacks_.edges.size(); ++start) {
    const LackingEdge& first = lacks_.edges[start];
    if (first.is_covered || first.is_chord || !(first.is_boundary || limits_.covers_walls)) continue;
    RETURN_IF_ERROR(monitor.check());
    const std::vector<std::uint32_t> loop = loop_from(start);
    for (const std::uint32_t i : loop) lacks_.edges[i].is_covered = !lacks_.edges[i].is_chord;
    const auto is_part_of_rim = [&](std::uint32_t i) {
      return !lacks_.edges[i].is_boundary || lacks_.edges[i].ends_at_wall;
    };
    if (loop.size() >= 3 && std::ranges::any_of(loop, is_part_of_rim)) add(cover_of(loop));
  }
  return {};
}

}  // namespace

Status close_rims(FacetList& facets, const RimLimits& limits, RepairReport& report, const Monitor& monitor) {
  return RimCloser(facets, limits, report).run(monitor);
}

}  // namespace algebra3d
