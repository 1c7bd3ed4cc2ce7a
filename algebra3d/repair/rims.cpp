#include "algebra3d/repair/rims.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/exact/predicates.h"
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
  void cover(const std::vector<std::uint32_t>& loop);

  FacetList& facets_;
  RimLimits limits_;
  RepairReport& report_;
  LackingEdges lacks_;
};

void RimCloser::cover(const std::vector<std::uint32_t>& loop) {
  Box3 box;
  Loop corners;
  for (const std::uint32_t i : loop) {
    corners.corners.push_back(facets_.points[lacks_.edges[i].from]);
    box.extend(corners.corners.back());
  }
  corners.beyond = corners.corners;
  const double diameter = length(box.max - box.min);
  if (diameter > limits_.largest) return;
  // A loop on one line closes by itself.
  HoleCover report{corners.corners[0], diameter, {}};
  for (const auto& [a, b, c] : triangulate_loop(corners, LoopMeasure::area)) {
    if (collinear(corners.corners[a], corners.corners[b], corners.corners[c])) continue;
    facets_.triangles.push_back({lacks_.edges[loop[a]].from, lacks_.edges[loop[b]].from, lacks_.edges[loop[c]].from});
    report.triangles.push_back({corners.corners[a], corners.corners[b], corners.corners[c]});
  }
  if (report.triangles.empty()) return;
  facets_.changed();
  report_.add(std::move(report));
}

Status RimCloser::run(const Monitor& monitor) {
  if (!lacks_.has_others || !(lacks_.has_boundary || limits_.covers_walls)) return {};
  for (std::uint32_t start = 0; start < lacks_.edges.size(); ++start) {
    const LackingEdge& first = lacks_.edges[start];
    if (first.is_covered || first.is_chord || !(first.is_boundary || limits_.covers_walls)) continue;
    RETURN_IF_ERROR(monitor.check());
    const std::vector<std::uint32_t> loop = lacks_.shortest_loop(start, facets_.points);
    for (const std::uint32_t i : loop) lacks_.edges[i].is_covered = !lacks_.edges[i].is_chord;
    const bool has_others = std::ranges::any_of(loop, [&](std::uint32_t i) { return !lacks_.edges[i].is_boundary; });
    if (has_others && loop.size() >= 3) cover(loop);
  }
  return {};
}

}  // namespace

Status close_rims(FacetList& facets, const RimLimits& limits, RepairReport& report, const Monitor& monitor) {
  return RimCloser(facets, limits, report).run(monitor);
}

}  // namespace algebra3d
