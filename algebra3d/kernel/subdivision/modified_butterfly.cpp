#include <utility>
#include <vector>

#include "algebra3d/kernel/subdivision/detail/butterfly_rules.h"
#include "algebra3d/kernel/subdivision/detail/ring_masks.h"
#include "base/propagate.h"

namespace algebra3d::subdivision {
namespace {

/// The new points on all edges. An edge at the boundary has the four-point rule; one between two regular vertices the
/// rule of eight points, or those of boundary vertices; one with an extraordinary end the mask of that end, with two
/// the mean of both. Regular are vertices with six triangles, and boundary vertices with three.
class EdgePoints {
 public:
  EdgePoints(const TriangleView& view, const Stage& stage, const EdgeEnumeration<TriangleView>& edges)
      : view_(view), stage_(stage) {
    points_.resize(edges.count());
    numbers_.resize(view.halfedge_count());
    is_extraordinary_.resize(view.vertex_count());
    for_each_element<VertexId>(view.vertex_count(), stage,
                               [&](VertexId v) { is_extraordinary_[v.index()] = find_extraordinary(v); });
    edges.for_each(stage, [&](HalfedgeId h, EdgeNumber e) {
      numbers_[h.index()] = e;
      if (!view_.is_boundary(h)) numbers_[view_.opposite(h).index()] = e;
      if (view_.is_boundary(h) || (!is_extraordinary(h) && !is_extraordinary(view_.opposite(h))))
        points_[e.index()] = regular_edge_point(view_, h);
    });
    // Each edge gets the point of its first half-edge's end before that of the other one, so no two tasks write one.
    add_extraordinary(true);
    add_extraordinary(false);
  }

  LargeVector<Vec3> take() && { return std::move(points_); }

 private:
  bool is_extraordinary(HalfedgeId h) const { return is_extraordinary_[view_.origin(h).index()] != 0; }

  std::uint8_t find_extraordinary(VertexId v) const {
    const HalfedgeId start = view_.outgoing(v);
    if (start.is_none()) return 0;
    std::size_t triangles = 0;
    view_.for_each_outgoing(start, [&](HalfedgeId) { ++triangles; });
    return triangles == (view_.is_boundary(start) ? 3U : 6U) ? 0 : 1;
  }

  void add_extraordinary(bool at_first_half) {
    for_each_block<VertexId>(view_.vertex_count(), stage_, [&](std::size_t, IdRange<VertexId> block) {
      std::vector<HalfedgeId> spokes;
      std::vector<Vec3> ring, made;
      for (const VertexId v : block)
        if (is_extraordinary_[v.index()] != 0) add_mask_of(v, at_first_half, spokes, ring, made);
    });
  }

  void add_mask_of(VertexId v, bool at_first_half, std::vector<HalfedgeId>& spokes, std::vector<Vec3>& ring,
                   std::vector<Vec3>& made) {
    spokes.clear();
    ring.clear();
    const HalfedgeId start = view_.outgoing(v);
    const HalfedgeId last = view_.for_each_outgoing(start, [&](HalfedgeId h) {
      spokes.push_back(h);
      ring.push_back(view_.target_point(h));
    });
    if (view_.is_boundary(start)) {
      ring.push_back(view_.origin_point(view_.prev(last)));
      boundary_edge_points(view_.point(v), ring, made);
    } else {
      interior_edge_points(view_.point(v), ring, made);
    }
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      const HalfedgeId h = spokes[i];
      if (view_.is_boundary(h) || view_.is_first_of_edge(h) != at_first_half) continue;
      Vec3& point = points_[numbers_[h.index()].index()];
      const bool is_second = !at_first_half && is_extraordinary(view_.opposite(h));
      point = is_second ? 0.5 * (point + made[i]) : made[i];
    }
  }

  TriangleView view_;
  Stage stage_;
  LargeVector<Vec3> points_;                    // per edge
  LargeVector<EdgeNumber> numbers_;             // per half-edge: its edge
  LargeVector<std::uint8_t> is_extraordinary_;  // per vertex
};

Result<PolygonMesh> modified_butterfly_step(const StepInput& input) {
  const TriangleView view(input.mesh);
  const Stage stage(input.monitor, input.what + ", edges",
                    2 * block_count(view.halfedge_count()) + 3 * block_count(view.vertex_count()));
  const EdgeEnumeration edges(view, Edges::all, stage);
  A3D_TRY(input.monitor.check());
  const LargeVector<Vec3> points = EdgePoints(view, stage, edges).take();
  A3D_TRY(input.monitor.check());
  return split_triangles(
      input, [&](HalfedgeId, EdgeNumber e) { return points[e.index()]; }, [&](VertexId v) { return view.point(v); });
}

}  // namespace

constinit const SchemeDescription kModifiedButterfly = {.name = "modified-butterfly",
                                                        .takes_triangles_only = true,
                                                        .needs_three_edges = true,
                                                        .after_step = four_times,
                                                        .step = modified_butterfly_step,
                                                        .provenance = triangle_split_provenance};

}  // namespace algebra3d::subdivision
