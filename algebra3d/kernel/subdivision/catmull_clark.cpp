#include <algorithm>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/subdivision/detail/creases.h"
#include "algebra3d/kernel/subdivision/detail/edge_enumeration.h"
#include "algebra3d/kernel/subdivision/detail/provenance.h"
#include "algebra3d/kernel/subdivision/detail/refined_mesh.h"
#include "algebra3d/kernel/subdivision/detail/scheme_description.h"
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
    if (sharpness_ != nullptr && sharpness_->edges[h] > 0)
      refined_.points[v] = creased_edge_point(sharpness_->edges[h], refined_.points[v], 0.5 * ends);
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
    if (start == kNone) {
      refined_.points[v] = view_.point(v);
    } else if (sharpness_ == nullptr) {
      refined_.points[v] = vertex_point(v, start);
    } else {
      refined_.points[v] = creased_vertex_point(view_, *sharpness_, v, [&] { return vertex_point(v, start); });
    }
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
  const Sharpness* sharpness_;
  Stage stage_;
  EdgeEnumeration<View> edges_;
  std::uint32_t first_face_point_;
  RefinedMesh refined_;
  LargeVector<std::uint32_t> edge_vertices_;  // per half-edge
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
    const std::vector<std::uint32_t> middles = corner_middles(mesh, blends.halfedges);
    for (const FaceId f : faces(mesh)) {
      poll_interruption_at(f.index());
      const std::uint32_t centre = mean_of_corners(mesh, f, blends.halfedges);
      for (const HalfedgeId h : halfedges_of(mesh, f))
        sources.halfedges.insert(sources.halfedges.end(),
                                 {h.index(), middles[h.index()], centre, middles[mesh.prev(h).index()]});
    }
  }
  if (given.has(MeshElement::edge)) {
    std::vector<std::uint32_t> along(after.halfedge_count(), kNone);
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
Vec3 smooth_limit(const MeshView<4>& view, std::uint32_t v) {
  Vec3 sum;
  double n = 0;
  view.for_each_outgoing(view.outgoing(v), [&](std::uint32_t h) {
    const std::uint32_t next = view.next(h);
    sum = sum + (4 * view.origin_point(next) + view.target_point(next));
    n += 1;
  });
  const Vec3 all = (n * n) * view.point(v) + sum;
  const double scale = n * (n + 5);
  return {all.x / scale, all.y / scale, all.z / scale};
}

/// The limit of an interior vertex with one sharp edge, to `end`: the left eigenvector of its step, in which the new
/// point on the sharp edge is the middle. Faces have 1 / (3 n^2) and 1/12 of the smooth edges beside them.
Vec3 quadrilateral_dart_limit(const MeshView<4>& view, std::uint32_t v, std::uint32_t end) {
  std::vector<std::uint32_t> spokes;
  view.for_each_outgoing(view.outgoing(v), [&](std::uint32_t h) { spokes.push_back(h); });
  std::ranges::rotate(spokes, std::ranges::find(spokes, end, [&](std::uint32_t h) { return view.target(h); }));
  const std::size_t count = spokes.size();
  const auto n = static_cast<double>(count);
  const std::vector<double> weights = dart_weights(count, 7, 20 / (n * n));
  Vec3 sum = view.point(v);
  double all = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t next = view.next(spokes[i]);
    const double beside = (i == 0 ? 0 : weights[i]) + (i + 1 == count ? 0 : weights[i + 1]);
    const double of_face = 1 / (3 * n * n) + beside / 12;
    sum = sum + (weights[i] * view.origin_point(next) + of_face * view.target_point(next));
    all += weights[i] + of_face;
  }
  return {sum.x / all, sum.y / all, sum.z / all};
}

Vec3 catmull_clark_limit(const MeshView<4>& view, const Sharpness* sharpness, std::uint32_t v) {
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
  return limits_of_vertices(input, view,
                            [&](std::uint32_t v) { return catmull_clark_limit(view, input.sharpness, v); });
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
