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
#include "base/propagate.h"

namespace algebra3d::subdivision {
namespace {

/// Whether step `number` divides boundary edges. A triangle then has one such edge at most: the step before has left
/// none with two.
bool divides_boundary(std::size_t number) {
  return number % 2 == 1;
}

/// The new vertices of a step, and the numbers of the half-edges of the result. Of an edge inside, half-edge h and its
/// opposite make a triangle each: triangle h has the origin of h, the apex of h across, and that in the triangle of h,
/// where the apex is the new vertex in the middle. At a boundary edge that stays, triangle h has origin, target, and
/// apex. A triangle with a boundary edge h that is divided has no vertex in the middle but two on the edge; that at the
/// origin is the apex of the half-edge before h, that at the target the apex of the one after h, and triangle h has
/// both and the corner opposite.
class TurnedTriangles {
 public:
  TurnedTriangles(const TriangleView& view, bool is_divided) : view_(view), is_divided_(is_divided) {}

  /// The boundary edge of a triangle, which is divided; kNone if it has none or is not divided.
  std::uint32_t divided_edge(std::uint32_t f) const {
    if (!is_divided_) return kNone;
    for (std::uint32_t h = 3 * f; h < 3 * f + 3; ++h)
      if (view_.is_boundary(h)) return h;
    return kNone;
  }
  std::uint32_t vertices_of_face(std::uint32_t f) const { return divided_edge(f) == kNone ? 1 : 2; }

  /// The apex of h in its triangle, whose new vertices begin with number `first`. Not for divided edges.
  std::uint32_t apex(std::uint32_t h, std::uint32_t first) const {
    const std::uint32_t divided = divided_edge(view_.face(h));
    return divided != kNone && view_.prev(h) == divided ? first + 1 : first;
  }

  /// The three corners of triangle h; `firsts` has the first new vertex of each face.
  std::array<std::uint32_t, 3> corners(std::uint32_t h, const LargeVector<std::uint32_t>& firsts) const {
    const std::uint32_t o = view_.opposite(h), first = firsts[view_.face(h)];
    if (o != kNone) return {view_.origin(h), apex(o, firsts[view_.face(o)]), apex(h, first)};
    if (is_divided_) return {first, first + 1, view_.origin(view_.prev(h))};
    return {view_.origin(h), view_.target(h), first};
  }

  std::array<std::uint32_t, 3> opposites(std::uint32_t h) const {
    const std::uint32_t o = view_.opposite(h), prev = view_.prev(h), next = view_.next(h);
    if (o == kNone) {
      if (is_divided_) return {kNone, 3 * view_.opposite(next), 3 * prev + 2};
      return {kNone, 3 * next + 2, from_apex(h)};
    }
    return {to_apex_across(o), 3 * o + 1, from_apex(h)};
  }

 private:
  /// The opposite of the third half-edge of triangle h, from the apex to the origin of h.
  std::uint32_t from_apex(std::uint32_t h) const {
    const std::uint32_t prev = view_.prev(h), divided = divided_edge(view_.face(h));
    if (divided == view_.next(h) && divided != kNone) return 3 * divided + 2;  // from the corner opposite the edge
    if (divided == prev && divided != kNone) return kNone;                     // on the boundary
    if (const std::uint32_t across = view_.opposite(prev); across != kNone) return 3 * across;
    return 3 * prev + 1;
  }
  /// The opposite of the first half-edge of the triangle of an edge inside, from its origin to the apex of o, its
  /// half-edge on the other side.
  std::uint32_t to_apex_across(std::uint32_t o) const {
    const std::uint32_t divided = divided_edge(view_.face(o));
    if (divided == kNone || divided == view_.next(o)) return divided == kNone ? 3 * view_.next(o) + 2 : kNone;
    return 3 * divided + 1;
  }

  TriangleView view_;
  bool is_divided_;
};

/// The new points.
class Sqrt3Points {
 public:
  explicit Sqrt3Points(const TriangleView& view) : view_(view) {}

  Vec3 middle(std::uint32_t f) const {
    const Vec3 sum = (view_.origin_point(3 * f) + view_.origin_point(3 * f + 1)) + view_.origin_point(3 * f + 2);
    return {sum.x / 3, sum.y / 3, sum.z / 3};
  }

  /// Both new points on a boundary edge: (a + 16 b + 10 c) / 27 near b and (10 b + 16 c + d) / 27 near c, of four
  /// consecutive vertices of the boundary.
  std::array<Vec3, 2> on_boundary(std::uint32_t h) const {
    const Vec3 &b = view_.origin_point(h), &c = view_.target_point(h);
    const Vec3& a = view_.point(view_.boundary_predecessor(view_.origin(h)));
    const Vec3& d = view_.target_point(view_.outgoing(view_.target(h)));
    return {divided_by_27((a + 16 * b) + 10 * c), divided_by_27((10 * b + 16 * c) + d)};
  }

  /// Inside, with a = (4 - 2 cos(2 pi / n)) / 9, a vertex keeps 1 - a of itself beside a of the mean of its n
  /// neighbours. At a boundary that is divided (4 a + 19 b + 4 c) / 27 with its neighbours there; otherwise it stays.
  Vec3 of_vertex(std::uint32_t v, bool is_divided) const {
    const std::uint32_t start = view_.outgoing(v);
    if (view_.is_boundary(start)) {
      if (!is_divided) return view_.point(v);
      const Vec3 beside = view_.target_point(start) + view_.point(view_.boundary_predecessor(v));
      return divided_by_27(19 * view_.point(v) + 4 * beside);
    }
    Vec3 sum;
    std::uint32_t count = 0;
    view_.for_each_outgoing(start, [&](std::uint32_t h) {
      sum = sum + view_.target_point(h);
      ++count;
    });
    const double share = (4 - 2 * circle_point(1, count).cosine) / 9;
    return (1 - share) * view_.point(v) + (share / count) * sum;
  }

 private:
  static Vec3 divided_by_27(const Vec3& sum) { return {sum.x / 27, sum.y / 27, sum.z / 27}; }

  TriangleView view_;
};

/// Per face the number of its first new vertex, and the end. Steps of the stage: 2 block_count(faces).
LargeVector<std::uint32_t> first_vertices(const TriangleView& view, const TurnedTriangles& turned, const Stage& stage) {
  std::vector<std::uint32_t> starts(block_count(view.face_count()) + 1, 0);
  for_each_block(view.face_count(), stage, [&](std::size_t block, std::uint32_t begin, std::uint32_t end) {
    std::uint32_t count = 0;
    for (std::uint32_t f = begin; f < end; ++f) count += turned.vertices_of_face(f);
    starts[block + 1] = count;
  });
  starts.front() = view.vertex_count();
  for (std::size_t block = 1; block < starts.size(); ++block) starts[block] += starts[block - 1];
  LargeVector<std::uint32_t> firsts;
  firsts.resize(std::size_t{view.face_count()} + 1);
  firsts.back() = starts.back();
  for_each_block(view.face_count(), stage, [&](std::size_t block, std::uint32_t begin, std::uint32_t end) {
    std::uint32_t first = starts[block];
    for (std::uint32_t f = begin; f < end; ++f) {
      firsts[f] = first;
      first += turned.vertices_of_face(f);
    }
  });
  return firsts;
}

/// The lowest half-edge that leaves a vertex inside: a triangle's first one, or that from the corner opposite a divided
/// edge.
std::uint32_t lowest_outgoing(const TriangleView& view, bool is_divided, std::uint32_t v) {
  std::uint32_t lowest = kNone;
  view.for_each_outgoing(view.outgoing(v), [&](std::uint32_t h) {
    lowest = std::min(lowest, 3 * h);
    if (const std::uint32_t next = view.next(h); is_divided && view.is_boundary(next))
      lowest = std::min(lowest, 3 * next + 2);
  });
  return lowest;
}

Result<PolygonMesh> sqrt3_step(const StepInput& input) {
  const TriangleView view(input.mesh);
  const bool is_divided = divides_boundary(input.number);
  const TurnedTriangles turned(view, is_divided);
  const Sqrt3Points points(view);
  const Stage stage(
      input.monitor, input.what,
      3 * block_count(view.face_count()) + block_count(view.halfedge_count()) + block_count(view.vertex_count()));
  const LargeVector<std::uint32_t> firsts = first_vertices(view, turned, stage);
  A3D_TRY(input.monitor.check());
  RefinedMesh refined(firsts.back(), std::size_t{3} * view.halfedge_count());
  for_each_element(view.face_count(), stage, [&](std::uint32_t f) {
    const std::uint32_t v = firsts[f];
    if (const std::uint32_t h = turned.divided_edge(f); h != kNone) {
      const auto [at_origin, at_target] = points.on_boundary(h);
      refined.points[v] = at_origin;
      refined.points[v + 1] = at_target;
      refined.outgoing[v] = HalfedgeId(3 * h);
      refined.outgoing[v + 1] = HalfedgeId(3 * view.next(h) + 2);
      return;
    }
    refined.points[v] = points.middle(f);
    std::uint32_t lowest = kNone;
    for (std::uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
      lowest = std::min(lowest, 3 * h + 2);
      if (const std::uint32_t o = view.opposite(h); o != kNone) lowest = std::min(lowest, 3 * o + 1);
    }
    refined.outgoing[v] = HalfedgeId(lowest);
  });
  for_each_element(view.halfedge_count(), stage, [&](std::uint32_t h) {
    const auto corners = turned.corners(h, firsts), opposites = turned.opposites(h);
    std::ranges::copy(corners, refined.corners.begin() + std::ptrdiff_t{3} * h);
    std::ranges::copy(opposites, refined.opposites.begin() + std::ptrdiff_t{3} * h);
  });
  for_each_element(view.vertex_count(), stage, [&](std::uint32_t v) {
    const std::uint32_t h = view.outgoing(v);
    if (h == kNone) {
      refined.points[v] = view.point(v);
      refined.outgoing[v] = HalfedgeId();
      return;
    }
    refined.points[v] = points.of_vertex(v, is_divided);
    if (!view.is_boundary(h)) {
      refined.outgoing[v] = HalfedgeId(lowest_outgoing(view, is_divided, v));
    } else {
      // To the first new vertex on the boundary, if there is one: in the triangle of the edge inside that comes next.
      refined.outgoing[v] = HalfedgeId(3 * (is_divided ? view.opposite(view.prev(h)) : h));
    }
  });
  return std::move(refined).finish(PolygonLayout::of_degree(3), input.monitor);
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
      if (const std::uint32_t h = turned.divided_edge(f.index()); h != kNone)
        sources.vertices.insert(sources.vertices.end(), 2,
                                blends.vertices.add_between(view.origin(h), view.target(h), 0.5));
      else
        sources.vertices.push_back(mean_of_vertices(mesh, f, blends.vertices));
    }
  }
  if (given.has(MeshElement::halfedge)) {
    // Per face the values of its new vertices, numbered from 0.
    std::vector<std::uint32_t> firsts, made;
    for (const FaceId f : faces(mesh)) {
      poll_interruption_at(f.index());
      firsts.push_back(static_cast<std::uint32_t>(made.size()));
      if (const std::uint32_t h = turned.divided_edge(f.index()); h != kNone) {
        made.push_back(blends.halfedges.add_between(h, view.next(h), 1.0 / 3));
        made.push_back(blends.halfedges.add_between(h, view.next(h), 2.0 / 3));
      } else {
        made.push_back(mean_of_corners(mesh, f, blends.halfedges));
      }
    }
    for (std::uint32_t h = 0; h < view.halfedge_count(); ++h) {
      poll_interruption_at(h);
      const std::uint32_t o = view.opposite(h), first = firsts[view.face(h)];
      if (o != kNone) {
        sources.halfedges.insert(sources.halfedges.end(),
                                 {blends.halfedges.add_between(h, view.next(o), 0.5),
                                  made[turned.apex(o, firsts[view.face(o)])], made[turned.apex(h, first)]});
      } else if (turned.divided_edge(view.face(h)) == h) {
        sources.halfedges.insert(sources.halfedges.end(), {made[first], made[first + 1], view.prev(h)});
      } else {
        sources.halfedges.insert(sources.halfedges.end(), {h, view.next(h), made[first]});
      }
    }
  }
  if (given.has(MeshElement::edge)) {
    std::vector<std::uint32_t> along(after.halfedge_count(), kNone);
    for (std::uint32_t h = 0; h < view.halfedge_count(); ++h) {
      if (!view.is_boundary(h)) continue;
      along[std::size_t{3} * h] = h;
      if (turned.divided_edge(view.face(h)) != h) continue;
      along[std::size_t{3} * view.opposite(view.prev(h))] = along[std::size_t{3} * view.next(h) + 2] = h;
    }
    sources.edges = edge_sources(after, mesh, along);
  }
  if (given.has(MeshElement::face))
    for (std::uint32_t h = 0; h < view.halfedge_count(); ++h) {
      const std::uint32_t o = view.opposite(h);
      sources.faces.push_back(o == kNone ? view.face(h) : blends.faces.add_between(view.face(h), view.face(o), 0.5));
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
