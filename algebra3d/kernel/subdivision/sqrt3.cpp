// Every triangle gets a vertex in its middle, and every edge inside turns to join the two beside it. Two steps divide
// an edge into three; so do boundary edges in every second step.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/trigonometry.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/subdivision/detail/edge_enumeration.h"
#include "algebra3d/kernel/subdivision/detail/provenance.h"
#include "algebra3d/kernel/subdivision/detail/refined_mesh.h"
#include "algebra3d/kernel/subdivision/detail/triangle_split.h"
#include "base/indices.h"
#include "base/propagate.h"

namespace algebra3d::subdivision {
namespace {

/// Whether step `number` divides boundary edges. A triangle then has one such edge at most: the step before has left
/// none with two.
bool divides_boundary(std::size_t number) {
  return number % 2 == 1;
}

/// The new vertices of a step, and the half-edges of the result. Of an edge inside, half-edge h and its opposite make a
/// triangle each: triangle h has the origin of h, the apex of h across, and that in the triangle of h, where the apex
/// is the new vertex in the middle. At a boundary edge that stays, triangle h has origin, target, and apex. A triangle
/// with a boundary edge h that is divided has no vertex in the middle but two on the edge; that at the origin is the
/// apex of the half-edge before h, that at the target the apex of the one after h, and triangle h has both and the
/// corner opposite.
class TurnedTriangles {
 public:
  TurnedTriangles(const TriangleView& view, bool is_divided) : view_(view), is_divided_(is_divided) {}

  /// The boundary edge of a triangle, which is divided; none if it has none or is not divided.
  HalfedgeId divided_edge(FaceId f) const {
    if (is_divided_)
      for (const HalfedgeId h : view_.halfedges_of(f))
        if (view_.is_boundary(h)) return h;
    return HalfedgeId::none();
  }
  std::size_t vertices_of_face(FaceId f) const { return divided_edge(f).is_none() ? 1 : 2; }

  /// The half-edges of triangle h.
  static HalfedgeId side(HalfedgeId h, unsigned place) { return HalfedgeId(3 * h.index() + place); }

  /// Which of the new vertices of its triangle is the apex of h, 0 or 1. Not for divided edges.
  std::size_t apex(HalfedgeId h) const {
    const HalfedgeId divided = divided_edge(view_.face(h));
    return divided.is_valid() && view_.prev(h) == divided ? 1 : 0;
  }

  /// The three corners of triangle h; `firsts` has the first new vertex of each face.
  std::array<VertexId, 3> corners(HalfedgeId h, const LargeVector<VertexId>& firsts) const {
    const auto made = [&](HalfedgeId of, std::size_t place) {
      return VertexId(firsts[view_.face(of).index()].index() + place);
    };
    const HalfedgeId o = view_.opposite(h);
    if (o.is_valid()) return {view_.origin(h), made(o, apex(o)), made(h, apex(h))};
    if (is_divided_) return {made(h, 0), made(h, 1), view_.origin(view_.prev(h))};
    return {view_.origin(h), view_.target(h), made(h, 0)};
  }

  std::array<HalfedgeId, 3> opposites(HalfedgeId h) const {
    const HalfedgeId o = view_.opposite(h), prev = view_.prev(h), next = view_.next(h);
    if (o.is_valid()) return {to_apex_across(o), side(o, 1), from_apex(h)};
    if (is_divided_) return {HalfedgeId::none(), side(view_.opposite(next), 0), side(prev, 2)};
    return {HalfedgeId::none(), side(next, 2), from_apex(h)};
  }

 private:
  /// The opposite of the third half-edge of triangle h, from the apex to the origin of h.
  HalfedgeId from_apex(HalfedgeId h) const {
    const HalfedgeId prev = view_.prev(h), divided = divided_edge(view_.face(h));
    if (divided.is_valid() && divided == view_.next(h)) return side(divided, 2);  // from the corner opposite the edge
    if (divided.is_valid() && divided == prev) return HalfedgeId::none();         // on the boundary
    if (const HalfedgeId across = view_.opposite(prev); across.is_valid()) return side(across, 0);
    return side(prev, 1);
  }
  /// The opposite of the first half-edge of the triangle of an edge inside, from its origin to the apex of o, its
  /// half-edge on the other side.
  HalfedgeId to_apex_across(HalfedgeId o) const {
    const HalfedgeId divided = divided_edge(view_.face(o));
    if (divided.is_none()) return side(view_.next(o), 2);
    return divided == view_.next(o) ? HalfedgeId::none() : side(divided, 1);
  }

  TriangleView view_;
  bool is_divided_;
};

/// The new points.
class Sqrt3Points {
 public:
  explicit Sqrt3Points(const TriangleView& view) : view_(view) {}

  Vec3 middle(FaceId f) const {
    Vec3 sum;
    for (const HalfedgeId h : view_.halfedges_of(f)) sum = sum + view_.origin_point(h);
    return {sum.x / 3, sum.y / 3, sum.z / 3};
  }

  /// Both new points on a boundary edge: (a + 16 b + 10 c) / 27 near b and (10 b + 16 c + d) / 27 near c, of four
  /// consecutive vertices of the boundary.
  std::array<Vec3, 2> on_boundary(HalfedgeId h) const {
    const Vec3 &b = view_.origin_point(h), &c = view_.target_point(h);
    const Vec3& a = view_.point(view_.boundary_predecessor(view_.origin(h)));
    const Vec3& d = view_.target_point(view_.outgoing(view_.target(h)));
    return {divided_by_27((a + 16 * b) + 10 * c), divided_by_27((10 * b + 16 * c) + d)};
  }

  /// Inside, with a = (4 - 2 cos(2 pi / n)) / 9, a vertex keeps 1 - a of itself beside a of the mean of its n
  /// neighbours. At a boundary that is divided (4 a + 19 b + 4 c) / 27 with its neighbours there; otherwise it stays.
  Vec3 of_vertex(VertexId v, bool is_divided) const {
    const HalfedgeId start = view_.outgoing(v);
    if (view_.is_boundary(start)) {
      if (!is_divided) return view_.point(v);
      const Vec3 beside = view_.target_point(start) + view_.point(view_.boundary_predecessor(v));
      return divided_by_27(19 * view_.point(v) + 4 * beside);
    }
    Vec3 sum;
    unsigned count = 0;
    view_.for_each_outgoing(start, [&](HalfedgeId h) {
      sum = sum + view_.target_point(h);
      ++count;
    });
    // Nine times the share, which is often a whole number.
    const double ninths = 4 - 2 * circle_point(1, count).cosine, n = count;
    const Vec3 mean{sum.x / n, sum.y / n, sum.z / n};
    const Vec3 all = (9 - ninths) * view_.point(v) + ninths * mean;
    return {all.x / 9, all.y / 9, all.z / 9};
  }

 private:
  static Vec3 divided_by_27(const Vec3& sum) { return {sum.x / 27, sum.y / 27, sum.z / 27}; }

  TriangleView view_;
};

/// Per face its first new vertex, and the end. Steps of the stage: 2 block_count(faces).
LargeVector<VertexId> first_vertices(const TriangleView& view, const TurnedTriangles& turned, const Stage& stage) {
  std::vector<std::size_t> starts(block_count(view.face_count()) + 1, 0);
  for_each_block<FaceId>(view.face_count(), stage, [&](std::size_t block, IdRange<FaceId> faces) {
    for (const FaceId f : faces) starts[block + 1] += turned.vertices_of_face(f);
  });
  starts.front() = view.vertex_count();
  for (std::size_t block = 1; block < starts.size(); ++block) starts[block] += starts[block - 1];
  LargeVector<VertexId> firsts;
  firsts.resize(view.face_count() + 1);
  firsts.back() = VertexId(starts.back());
  for_each_block<FaceId>(view.face_count(), stage, [&](std::size_t block, IdRange<FaceId> faces) {
    std::size_t first = starts[block];
    for (const FaceId f : faces) {
      firsts[f.index()] = VertexId(first);
      first += turned.vertices_of_face(f);
    }
  });
  return firsts;
}

/// A step over a mesh of triangles.
class Sqrt3Step {
 public:
  explicit Sqrt3Step(const StepInput& input)
      : view_(input.mesh),
        monitor_(input.monitor),
        is_divided_(divides_boundary(input.number)),
        turned_(view_, is_divided_),
        points_(view_),
        stage_(input.monitor, input.what,
               3 * block_count(view_.face_count()) + block_count(view_.halfedge_count()) +
                   block_count(view_.vertex_count())) {}

  Result<PolygonMesh> step() {
    const LargeVector<VertexId> firsts = first_vertices(view_, turned_, stage_);
    A3D_TRY(monitor_.check());
    RefinedMesh refined(firsts.back().index(), 3 * view_.halfedge_count());
    for_each_element<FaceId>(view_.face_count(), stage_,
                             [&](FaceId f) { make_vertices(f, firsts[f.index()], refined); });
    for_each_element<HalfedgeId>(view_.halfedge_count(), stage_, [&](HalfedgeId h) {
      const auto corners = turned_.corners(h, firsts);
      const auto opposites = turned_.opposites(h);
      for (unsigned place = 0; place < 3; ++place) {
        refined.set_corner(TurnedTriangles::side(h, place), corners[place]);
        refined.set_opposite(TurnedTriangles::side(h, place), opposites[place]);
      }
    });
    for_each_element<VertexId>(view_.vertex_count(), stage_, [&](VertexId v) { move_vertex(v, refined); });
    return std::move(refined).finish(PolygonLayout::of_degree(3), monitor_);
  }

 private:
  void make_vertices(FaceId f, VertexId first, RefinedMesh& refined) const {
    if (const HalfedgeId h = turned_.divided_edge(f); h.is_valid()) {
      const auto [at_origin, at_target] = points_.on_boundary(h);
      refined.set_vertex(first, at_origin, TurnedTriangles::side(h, 0));
      refined.set_vertex(VertexId(first.index() + 1), at_target, TurnedTriangles::side(view_.next(h), 2));
      return;
    }
    HalfedgeId lowest;
    for (const HalfedgeId h : view_.halfedges_of(f)) {
      lowest = std::min(lowest, TurnedTriangles::side(h, 2));
      if (const HalfedgeId o = view_.opposite(h); o.is_valid()) lowest = std::min(lowest, TurnedTriangles::side(o, 1));
    }
    refined.set_vertex(first, points_.middle(f), lowest);
  }

  void move_vertex(VertexId v, RefinedMesh& refined) const {
    const HalfedgeId h = view_.outgoing(v);
    if (h.is_none())
      refined.set_vertex(v, view_.point(v), h);
    else
      refined.set_vertex(v, points_.of_vertex(v, is_divided_), outgoing_after(h));
  }

  /// The half-edge that leaves the origin of h, its outgoing one. At the boundary that along the first edge, which if
  /// it is divided is in the triangle of the edge inside that comes next. Inside the lowest: the first one of a
  /// triangle, or that from the corner opposite a divided edge.
  HalfedgeId outgoing_after(HalfedgeId h) const {
    if (view_.is_boundary(h)) return TurnedTriangles::side(is_divided_ ? view_.opposite(view_.prev(h)) : h, 0);
    HalfedgeId lowest;
    view_.for_each_outgoing(h, [&](HalfedgeId leaving) {
      lowest = std::min(lowest, TurnedTriangles::side(leaving, 0));
      const HalfedgeId next = view_.next(leaving);
      if (is_divided_ && view_.is_boundary(next)) lowest = std::min(lowest, TurnedTriangles::side(next, 2));
    });
    return lowest;
  }

  TriangleView view_;
  const Monitor& monitor_;
  bool is_divided_;
  TurnedTriangles turned_;
  Sqrt3Points points_;
  Stage stage_;
};

Result<PolygonMesh> sqrt3_step(const StepInput& input) {
  return Sqrt3Step(input).step();
}

/// A corner at a vertex of the mesh has the mean of both faces; one at a new vertex that of the face, or a third of the
/// way along the boundary.
void add_corner_sources(const PolygonMesh& mesh, const TurnedTriangles& turned, ValueBlends& blends,
                        ValueSources& sources) {
  // Per face the values of its new vertices, numbered from 0.
  std::vector<std::size_t> firsts;
  ValueSources made;
  for (const FaceId f : faces(mesh)) {
    poll_interruption_at(f.index());
    firsts.push_back(made.size());
    if (const HalfedgeId h = turned.divided_edge(f); h.is_valid()) {
      for (const double share : {1.0 / 3, 2.0 / 3})
        made.push_back(blends.add_between(h.index(), mesh.next(h).index(), share));
    } else {
      made.push_back(mean_of_corners(mesh, f, blends));
    }
  }
  const auto value = [&](HalfedgeId h, std::size_t place) { return made[firsts[mesh.face(h).index()] + place]; };
  for (const HalfedgeId h : halfedges(mesh)) {
    poll_interruption_at(h.index());
    const HalfedgeId o = mesh.opposite(h);
    if (o.is_valid()) {
      const auto at_origin = blends.add_between(h.index(), mesh.next(o).index(), 0.5);
      sources.insert(sources.end(), {at_origin, value(o, turned.apex(o)), value(h, turned.apex(h))});
    } else if (turned.divided_edge(mesh.face(h)) == h) {
      sources.insert(sources.end(), {value(h, 0), value(h, 1), mesh.prev(h).index()});
    } else {
      sources.insert(sources.end(), {h.index(), mesh.next(h).index(), value(h, 0)});
    }
  }
}

/// New triangles and their corners lie in two triangles of the mesh, and have the means of both; boundary edges keep
/// their values, also their thirds. All other edges are new.
Provenance sqrt3_provenance(const StepInput& input, const PolygonMesh& after, const MeshAttributes& given) {
  const PolygonMesh& mesh = input.mesh;
  const TriangleView view(mesh);
  const TurnedTriangles turned(view, divides_boundary(input.number));
  Provenance provenance{{}, ElementBlends(mesh)};
  auto& [sources, blends] = provenance;
  if (given.has(MeshElement::vertex)) {
    for (const VertexId v : vertices(mesh)) sources.vertices.push_back(v.index());
    for (const FaceId f : faces(mesh)) {
      if (const HalfedgeId h = turned.divided_edge(f); h.is_valid())
        sources.vertices.insert(sources.vertices.end(), 2,
                                blends.vertices.add_between(view.origin(h).index(), view.target(h).index(), 0.5));
      else
        sources.vertices.push_back(mean_of_vertices(mesh, f, blends.vertices));
    }
  }
  if (given.has(MeshElement::halfedge)) add_corner_sources(mesh, turned, blends.halfedges, sources.halfedges);
  if (given.has(MeshElement::edge)) {
    ValueSources along(after.halfedge_count(), kNone);
    const auto add = [&](HalfedgeId side, HalfedgeId h) { along[side.index()] = h.index(); };
    for (const HalfedgeId h : halfedges(mesh)) {
      if (!mesh.is_boundary(h)) continue;
      add(TurnedTriangles::side(h, 0), h);
      if (turned.divided_edge(view.face(h)) != h) continue;
      add(TurnedTriangles::side(view.opposite(view.prev(h)), 0), h);
      add(TurnedTriangles::side(view.next(h), 2), h);
    }
    sources.edges = edge_sources(after, mesh, along);
  }
  if (given.has(MeshElement::face))
    for (const HalfedgeId h : halfedges(mesh)) {
      const HalfedgeId o = mesh.opposite(h);
      const auto own = mesh.face(h).index();
      sources.faces.push_back(o.is_none() ? own : blends.faces.add_between(own, mesh.face(o).index(), 0.5));
    }
  return provenance;
}

MeshSize three_times(const MeshSize& size, std::size_t /*variant*/) {
  return {3 * size.halfedges, 3 * size.boundary_halfedges};
}

}  // namespace

constinit const SchemeDescription kSqrt3 = {.name = "sqrt3",
                                            .takes_triangles_only = true,
                                            .needs_three_edges = true,
                                            .needs_distinct_sides = true,
                                            .after_step = three_times,
                                            .step = sqrt3_step,
                                            .provenance = sqrt3_provenance};

}  // namespace algebra3d::subdivision
