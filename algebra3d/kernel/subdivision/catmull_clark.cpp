#include <algorithm>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/subdivision/detail/creases.h"
#include "algebra3d/kernel/subdivision/detail/edge_enumeration.h"
#include "algebra3d/kernel/subdivision/detail/provenance.h"
#include "algebra3d/kernel/subdivision/detail/refined_mesh.h"
#include "algebra3d/kernel/subdivision/detail/scheme_description.h"
#include "base/indices.h"
#include "base/propagate.h"

namespace algebra3d::subdivision {
namespace {

/// A step of Catmull-Clark. Quadrilateral h of the result belongs to the corner that half-edge h leaves: corner, vertex
/// on the edge of h, vertex of the face, vertex on the edge before.
template <typename View>
class CatmullClark {
 public:
  CatmullClark(const View& view, const StepInput& input)
      : view_(view),
        monitor_(input.monitor),
        sharpness_(input.sharpness),
        stage_(input.monitor, input.what,
               2 * block_count(view.halfedge_count()) + 2 * block_count(view.face_count()) +
                   block_count(view.vertex_count())),
        edges_(view, Edges::all, stage_),
        first_face_point_(view.vertex_count() + edges_.count()),
        refined_(first_face_point_ + view.face_count(), 4 * view.halfedge_count()) {}

  Result<PolygonMesh> step() {
    A3D_TRY(monitor_.check());
    edge_vertices_.resize(view_.halfedge_count());
    for_each_element<FaceId>(view_.face_count(), stage_, [&](FaceId f) { make_face_point(f); });
    edges_.for_each(
        stage_, [&](HalfedgeId h, EdgeNumber e) { make_edge_point(h, VertexId(view_.vertex_count() + e.index())); });
    A3D_TRY(monitor_.check());
    for_each_element<FaceId>(view_.face_count(), stage_, [&](FaceId f) { write_quadrilaterals(f); });
    for_each_element<VertexId>(view_.vertex_count(), stage_, [&](VertexId v) { move_vertex(v); });
    return std::move(refined_).finish(PolygonLayout::of_degree(4), monitor_);
  }

 private:
  VertexId face_vertex(FaceId f) const { return VertexId(first_face_point_ + f.index()); }
  const Vec3& face_point(FaceId f) const { return refined_.points[face_vertex(f).index()]; }
  /// The half-edges of the quadrilateral of h: to the vertex on its edge, to that of the face, to that on the edge
  /// before, and back.
  static HalfedgeId side(HalfedgeId h, unsigned place) { return HalfedgeId(4 * h.index() + place); }

  void make_face_point(FaceId f) {
    Vec3 sum;
    for (const HalfedgeId h : view_.halfedges_of(f)) sum = sum + view_.origin_point(h);
    // A division rounds once where 1 / degree would round twice.
    const double n = view_.degree(f);
    refined_.set_vertex(face_vertex(f), {sum.x / n, sum.y / n, sum.z / n}, side(view_.first(f), 2));
  }

  void make_edge_point(HalfedgeId h, VertexId v) {
    const HalfedgeId o = view_.opposite(h), at_end = side(view_.next(h), 3);
    const Vec3 ends = view_.origin_point(h) + view_.target_point(h);
    edge_vertices_[h.index()] = v;
    if (o.is_none()) {
      refined_.set_vertex(v, 0.5 * ends, at_end);
      return;
    }
    edge_vertices_[o.index()] = v;
    Vec3 point = 0.25 * (ends + (face_point(view_.face(h)) + face_point(view_.face(o))));
    if (sharpness_ != nullptr && sharpness_->edges[h.index()] > 0)
      point = creased_edge_point(sharpness_->edges[h.index()], point, 0.5 * ends);
    // Half-edges that leave the vertex: two in each face, which may be one face.
    refined_.set_vertex(v, point, std::min({side(h, 1), at_end, side(o, 1), side(view_.next(o), 3)}));
  }

  void write_quadrilaterals(FaceId f) {
    const IdRange<HalfedgeId> sides = view_.halfedges_of(f);
    const HalfedgeId last(sides.front().index() + view_.degree(f) - 1);
    HalfedgeId before = last;
    for (const HalfedgeId h : sides) {
      const HalfedgeId after = h == last ? sides.front() : HalfedgeId(h.index() + 1);
      refined_.set_corner(side(h, 0), view_.origin(h));
      refined_.set_corner(side(h, 1), edge_vertices_[h.index()]);
      refined_.set_corner(side(h, 2), face_vertex(f));
      refined_.set_corner(side(h, 3), edge_vertices_[before.index()]);
      const HalfedgeId o = view_.opposite(h), o_before = view_.opposite(before);
      refined_.set_opposite(side(h, 0), o.is_none() ? o : side(view_.next(o), 3));
      refined_.set_opposite(side(h, 1), side(after, 2));
      refined_.set_opposite(side(h, 2), side(before, 1));
      refined_.set_opposite(side(h, 3), o_before.is_none() ? o_before : side(o_before, 0));
      before = h;
    }
  }

  void move_vertex(VertexId v) {
    const HalfedgeId start = view_.outgoing(v);
    if (start.is_none()) {
      refined_.set_vertex(v, view_.point(v), start);
    } else if (sharpness_ == nullptr) {
      refined_.set_vertex(v, vertex_point(v, start), side(start, 0));
    } else {
      const Vec3 point = creased_vertex_point(view_, *sharpness_, v, [&] { return vertex_point(v, start); });
      refined_.set_vertex(v, point, side(start, 0));
    }
  }

  /// At the boundary a cubic B-spline. Inside, with Q the mean of the face points, R that of the midpoints of the
  /// edges, S the vertex: (Q + 2 R + (n - 3) S) / n, with R written by its ends.
  Vec3 vertex_point(VertexId v, HalfedgeId start) const {
    if (view_.is_boundary(start))
      return 0.75 * view_.point(v) + 0.125 * (view_.target_point(start) + view_.point(view_.boundary_predecessor(v)));
    Vec3 sum;
    double n = 0;
    view_.for_each_outgoing(start, [&](HalfedgeId h) {
      sum = sum + (view_.target_point(h) + face_point(view_.face(h)));
      n += 1;
    });
    return ((n - 2) / n) * view_.point(v) + (1 / (n * n)) * sum;
  }

  View view_;
  Monitor monitor_;
  const Sharpness* sharpness_;
  Stage stage_;
  EdgeEnumeration<View> edges_;
  std::size_t first_face_point_;
  RefinedMesh refined_;
  LargeVector<VertexId> edge_vertices_;  // per half-edge
};

Result<PolygonMesh> catmull_clark_step(const StepInput& input) {
  return with_view(input.mesh, [&](const auto& view) { return CatmullClark(view, input).step(); });
}

/// A quadrilateral for each corner: corner, middle of its half-edge, middle of the face, middle of the one before.
Provenance catmull_clark_provenance(const StepInput& input, const PolygonMesh& after, const MeshAttributes& given) {
  const PolygonMesh& mesh = input.mesh;
  Provenance provenance{{}, ElementBlends(mesh)};
  auto& [sources, blends] = provenance;
  if (given.has(MeshElement::vertex)) {
    sources.vertices = vertices_and_middles(mesh, blends.vertices);
    for (const FaceId f : faces(mesh)) sources.vertices.push_back(mean_of_vertices(mesh, f, blends.vertices));
  }
  if (given.has(MeshElement::halfedge)) {
    const ValueSources middles = corner_middles(mesh, blends.halfedges);
    for (const FaceId f : faces(mesh)) {
      poll_interruption_at(f.index());
      const auto centre = mean_of_corners(mesh, f, blends.halfedges);
      for (const HalfedgeId h : halfedges_of(mesh, f))
        sources.halfedges.insert(sources.halfedges.end(),
                                 {h.index(), middles[h.index()], centre, middles[mesh.prev(h).index()]});
    }
  }
  if (given.has(MeshElement::edge)) {
    ValueSources along(after.halfedge_count(), kNone);
    for (const HalfedgeId h : halfedges(mesh)) {
      poll_interruption_at(h.index());
      const std::size_t start = std::size_t{4} * h.index();
      along[start] = h.index();
      along[start + 3] = mesh.prev(h).index();
    }
    sources.edges = edge_sources(after, mesh, along);
  }
  if (given.has(MeshElement::face))
    for (const HalfedgeId h : halfedges(mesh)) sources.faces.push_back(mesh.face(h).index());
  return provenance;
}

/// The sum of the neighbours along edges, and that of the corners opposite in the faces: e and f of the limit (n^2 v +
/// 4 e + f) / (n (n + 5)) of a vertex with n quadrilaterals. Source: [halstead1993].
Vec3 smooth_limit(const MeshView<4>& view, VertexId v) {
  Vec3 sum;
  double n = 0;
  view.for_each_outgoing(view.outgoing(v), [&](HalfedgeId h) {
    const HalfedgeId next = view.next(h);
    sum = sum + (4 * view.origin_point(next) + view.target_point(next));
    n += 1;
  });
  const Vec3 all = (n * n) * view.point(v) + sum;
  const double scale = n * (n + 5);
  return {all.x / scale, all.y / scale, all.z / scale};
}

/// The limit of an interior vertex with one sharp edge, to `end`: the left eigenvector of its step, in which the new
/// point on the sharp edge is the middle. Faces have 1 / (3 n^2) and 1/12 of the smooth edges beside them.
Vec3 quadrilateral_dart_limit(const MeshView<4>& view, VertexId v, VertexId end) {
  std::vector<HalfedgeId> spokes;
  view.for_each_outgoing(view.outgoing(v), [&](HalfedgeId h) { spokes.push_back(h); });
  std::ranges::rotate(spokes, std::ranges::find(spokes, end, [&](HalfedgeId h) { return view.target(h); }));
  const std::size_t count = spokes.size();
  const auto n = static_cast<double>(count);
  const std::vector<double> weights = dart_weights(count, 7, 20 / (n * n));
  Vec3 sum = view.point(v);
  double all = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const HalfedgeId next = view.next(spokes[i]);
    const double beside = (i == 0 ? 0 : weights[i]) + (i + 1 == count ? 0 : weights[i + 1]);
    const double of_face = 1 / (3 * n * n) + beside / 12;
    sum = sum + (weights[i] * view.origin_point(next) + of_face * view.target_point(next));
    all += weights[i] + of_face;
  }
  return {sum.x / all, sum.y / all, sum.z / all};
}

Vec3 catmull_clark_limit(const MeshView<4>& view, const Sharpness* sharpness, VertexId v) {
  if (sharpness != nullptr) {
    const CreaseRule rule = crease_rule(view, *sharpness, v, 0);
    if (rule.kind == CreaseKind::corner) return view.point(v);
    if (rule.kind == CreaseKind::crease)
      return curve_limit(view.point(v), view.point(rule.ends[0]) + view.point(rule.ends[1]));
    return rule.sharp_edges == 1 ? quadrilateral_dart_limit(view, v, rule.ends[0]) : smooth_limit(view, v);
  }
  if (view.is_boundary_vertex(v))
    return curve_limit(view.point(v), view.target_point(view.outgoing(v)) + view.point(view.boundary_predecessor(v)));
  return smooth_limit(view, v);
}

/// After a step all faces are quadrilaterals.
Result<std::vector<Vec3>> catmull_clark_limits(const LimitInput& input) {
  const MeshView<4> view(input.mesh);
  return limits_of_vertices(input, view, [&](VertexId v) { return catmull_clark_limit(view, input.sharpness, v); });
}

}  // namespace

constinit const SchemeDescription kCatmullClark = {.name = "catmull-clark",
                                                   .needs_distinct_sides = true,
                                                   .honours_creases = true,
                                                   .after_step = four_times,
                                                   .step = catmull_clark_step,
                                                   .provenance = catmull_clark_provenance,
                                                   .limits = catmull_clark_limits,
                                                   .steps_before_limits = 1};

}  // namespace algebra3d::subdivision
