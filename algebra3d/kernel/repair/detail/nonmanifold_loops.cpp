#include "algebra3d/kernel/repair/detail/nonmanifold_loops.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/repair/detail/convex_polygon.h"
#include "algebra3d/kernel/repair/detail/missing_halfedges.h"
#include "algebra3d/kernel/soup/loop_triangulation.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

class NonmanifoldLoopCloser {
 public:
  NonmanifoldLoopCloser(IndexedSoup& soup, const NonmanifoldLoopLimits& limits, RepairReport& report)
      : soup_(soup), limits_(limits), report_(report), missing_(*soup.mesh()) {
    if (limits.takes_shortcuts) missing_.add_chords(*soup.mesh());
  }

  Status run(const Monitor& monitor);

 private:
  struct Cover {
    HoleCover report;
    std::vector<TriangleMesh::Triangle> triangles;
    double area = 0;
  };

  bool may_start(const MissingHalfedge& edge) const;
  bool is_of_nonmanifold_loop(const MissingHalfedge& edge) const;
  std::vector<MissingId> loop_from(MissingId start) const;
  Cover cover_of(const std::vector<MissingId>& loop) const;
  void add(Cover cover);

  IndexedSoup& soup_;
  NonmanifoldLoopLimits limits_;
  RepairReport& report_;
  MissingHalfedges missing_;
};

/// Without triangles if the loop is too large, or lies on one line: then it is closed as it is.
NonmanifoldLoopCloser::Cover NonmanifoldLoopCloser::cover_of(const std::vector<MissingId>& loop) const {
  Box3 box;
  Loop corners;
  Cover result;
  for (const MissingId i : loop) {
    corners.corners.push_back(soup_.point(missing_.edges[i].from));
    box.extend(corners.corners.back());
  }
  corners.beyond = corners.corners;
  const double diameter = length(box.max - box.min);
  result.report = {corners.corners[0], diameter, {}};
  if (diameter > limits_.largest) return result;
  const auto vertex = [&](std::uint32_t corner) { return missing_.edges[loop[corner]].from.index(); };
  for (const auto& [a, b, c] : triangulate_loop(corners, LoopMeasure::area)) {
    if (collinear(corners.corners[a], corners.corners[b], corners.corners[c])) continue;
    result.triangles.push_back({vertex(a), vertex(b), vertex(c)});
    result.report.triangles.push_back({corners.corners[a], corners.corners[b], corners.corners[c]});
    result.area += area_of(result.report.triangles.back());
  }
  return result;
}

void NonmanifoldLoopCloser::add(Cover cover) {
  if (cover.triangles.empty()) return;
  soup_.add(cover.triangles);
  report_.add(std::move(cover.report));
}

/// The shortest loop; or that along boundaries alone if its cover is smaller, as for the gap between a cap that hangs
/// on an interface and the rim on which it should lie.
std::vector<MissingId> NonmanifoldLoopCloser::loop_from(MissingId start) const {
  std::vector<MissingId> shortest = missing_.shortest_loop(start, soup_.points);
  if (!missing_.edges[start].ends_at_interface) return shortest;
  std::vector<MissingId> along = missing_.shortest_loop(start, soup_.points, MissingHalfedges::Way::boundary);
  if (along.size() < 3 || along == shortest) return shortest;
  const bool is_smaller = shortest.size() < 3 || cover_of(along).area < cover_of(shortest).area;
  return is_smaller ? along : shortest;
}

bool NonmanifoldLoopCloser::may_start(const MissingHalfedge& edge) const {
  return !edge.is_covered && !edge.is_chord && (edge.is_boundary || limits_.covers_interfaces);
}

/// False for edges of closed boundary loops, which are ordinary holes.
bool NonmanifoldLoopCloser::is_of_nonmanifold_loop(const MissingHalfedge& edge) const {
  return !edge.is_boundary || edge.ends_at_interface;
}

Status NonmanifoldLoopCloser::run(const Monitor& monitor) {
  if (!missing_.has_nonmanifold || !(missing_.has_boundary || limits_.covers_interfaces)) return {};
  for (const MissingId start : missing_.edges.ids()) {
    if (!may_start(missing_.edges[start])) continue;
    A3D_TRY(monitor.check());
    const std::vector<MissingId> loop = loop_from(start);
    for (const MissingId i : loop) missing_.edges[i].is_covered = !missing_.edges[i].is_chord;
    const auto is_nonmanifold = [&](MissingId i) { return is_of_nonmanifold_loop(missing_.edges[i]); };
    if (loop.size() >= 3 && std::ranges::any_of(loop, is_nonmanifold)) add(cover_of(loop));
  }
  return {};
}

}  // namespace

Status close_nonmanifold_loops(IndexedSoup& soup, const NonmanifoldLoopLimits& limits, RepairReport& report,
                               const Monitor& monitor) {
  return NonmanifoldLoopCloser(soup, limits, report).run(monitor);
}

}  // namespace algebra3d
