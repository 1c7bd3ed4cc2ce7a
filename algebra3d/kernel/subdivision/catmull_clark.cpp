#include <algorithm>

#include "algebra3d/kernel/subdivision/detail/edge_enumeration.h"
#include "algebra3d/kernel/subdivision/detail/refined_mesh.h"
#include "algebra3d/kernel/subdivision/detail/steps.h"
#include "base/propagate.h"

namespace algebra3d::subdivision {
namespace {

/// A step of Catmull-Clark. Quadrilateral h of the result belongs to the corner that half-edge h leaves: corner, vertex
/// on the edge of h, vertex of the face, vertex on the edge before.
template <typename View>
class CatmullClark {
 public:
  CatmullClark(const View& view, const Monitor& monitor, const std::string& what)
      : view_(view),
        monitor_(monitor),
        stage_(monitor, what,
               2 * block_count(view.halfedge_count()) + 2 * block_count(view.face_count()) +
                   block_count(view.vertex_count())),
        edges_(view, Edges::all, stage_),
        first_face_point_(view.vertex_count() + edges_.count()),
        refined_(std::size_t{first_face_point_} + view.face_count(), std::size_t{4} * view.halfedge_count()) {}

  Result<PolygonMesh> step() {
    A3D_TRY(monitor_.check());
    edge_vertices_.resize(view_.halfedge_count());
    for_each_element(view_.face_count(), stage_, [&](std::uint32_t f) { make_face_point(f); });
    edges_.for_each(stage_, [&](std::uint32_t h, std::uint32_t e) { make_edge_point(h, view_.vertex_count() + e); });
    A3D_TRY(monitor_.check());
    for_each_element(view_.face_count(), stage_, [&](std::uint32_t f) { write_quadrilaterals(f); });
    for_each_element(view_.vertex_count(), stage_, [&](std::uint32_t v) { move_vertex(v); });
    return std::move(refined_).finish(PolygonLayout::of_degree(4), monitor_);
  }

 private:
  const Vec3& face_point(std::uint32_t f) const { return refined_.points[first_face_point_ + f]; }

  void make_face_point(std::uint32_t f) {
    const std::uint32_t first = view_.first(f), degree = view_.degree(f);
    Vec3 sum;
    for (std::uint32_t h = first; h < first + degree; ++h) sum = sum + view_.origin_point(h);
    // A division rounds once where 1 / degree would round twice.
    const double n = degree;
    refined_.points[first_face_point_ + f] = {sum.x / n, sum.y / n, sum.z / n};
    refined_.outgoing[first_face_point_ + f] = HalfedgeId(4 * first + 2);
  }

  void make_edge_point(std::uint32_t h, std::uint32_t v) {
    const std::uint32_t o = view_.opposite(h), at_end = 4 * view_.next(h) + 3;
    const Vec3 ends = view_.origin_point(h) + view_.target_point(h);
    edge_vertices_[h] = v;
    if (o == kNone) {
      refined_.points[v] = 0.5 * ends;
      refined_.outgoing[v] = HalfedgeId(at_end);
      return;
    }
    edge_vertices_[o] = v;
    refined_.points[v] = 0.25 * (ends + (face_point(view_.face(h)) + face_point(view_.face(o))));
    // Half-edges that leave the vertex: two in each face, which may be one face.
    refined_.outgoing[v] = HalfedgeId(std::min({4 * h + 1, at_end, 4 * o + 1, 4 * view_.next(o) + 3}));
  }

  void write_quadrilaterals(std::uint32_t f) {
    const std::uint32_t first = view_.first(f), end = first + view_.degree(f);
    for (std::uint32_t h = first, before = end - 1; h < end; before = h++) {
      const std::uint32_t after = h + 1 == end ? first : h + 1;
      std::uint32_t* corners = refined_.corners.data() + std::size_t{4} * h;
      corners[0] = view_.origin(h);
      corners[1] = edge_vertices_[h];
      corners[2] = first_face_point_ + f;
      corners[3] = edge_vertices_[before];
      std::uint32_t* opposites = refined_.opposites.data() + std::size_t{4} * h;
      const std::uint32_t o = view_.opposite(h), o_before = view_.opposite(before);
      opposites[0] = o == kNone ? kNone : 4 * view_.next(o) + 3;
      opposites[1] = 4 * after + 2;
      opposites[2] = 4 * before + 1;
      opposites[3] = o_before == kNone ? kNone : 4 * o_before;
    }
  }

  void move_vertex(std::uint32_t v) {
    const std::uint32_t start = view_.outgoing(v);
    refined_.outgoing[v] = start == kNone ? HalfedgeId() : HalfedgeId(4 * start);
    refined_.points[v] = start == kNone ? view_.point(v) : vertex_point(v, start);
  }

  /// At the boundary a cubic B-spline. Inside, with Q the mean of the face points, R that of the midpoints of the
  /// edges, S the vertex: (Q + 2 R + (n - 3) S) / n, with R written by its ends.
  Vec3 vertex_point(std::uint32_t v, std::uint32_t start) const {
    if (view_.is_boundary(start))
      return 0.75 * view_.point(v) + 0.125 * (view_.target_point(start) + view_.point(view_.boundary_predecessor(v)));
    Vec3 sum;
    double n = 0;
    view_.for_each_outgoing(start, [&](std::uint32_t h) {
      sum = sum + (view_.target_point(h) + face_point(view_.face(h)));
      n += 1;
    });
    return ((n - 2) / n) * view_.point(v) + (1 / (n * n)) * sum;
  }

  View view_;
  Monitor monitor_;
  Stage stage_;
  EdgeEnumeration<View> edges_;
  std::uint32_t first_face_point_;
  RefinedMesh refined_;
  LargeVector<std::uint32_t> edge_vertices_;  // per half-edge
};

}  // namespace

Result<PolygonMesh> catmull_clark_step(const PolygonMesh& mesh, const Monitor& monitor, const std::string& what) {
  return with_view(mesh, [&](const auto& view) { return CatmullClark(view, monitor, what).step(); });
}

}  // namespace algebra3d::subdivision
