#include "algebra3d/kernel/halfedge/topology.h"

#include <algorithm>
#include <compare>

#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/relinked.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

/// Counts of one component, as its own surface.
struct ComponentCounts {
  std::int64_t vertices = 0;
  std::int64_t fans = 0;
  std::int64_t edges = 0;
  std::int64_t faces = 0;
  std::int64_t boundary_edges = 0;
  std::int64_t nonmanifold_edges = 0;
};

template <typename Layout>
std::vector<ComponentCounts> count_elements(const HalfedgeMesh<Layout>& mesh, const FaceComponents& components) {
  std::vector<ComponentCounts> counts(components.count);
  const auto component_of = [&](HalfedgeId h) { return components.of_face[mesh.face(h).index()]; };
  for (const std::uint32_t component : components.of_face) ++counts[component].faces;
  for (const HalfedgeId h : edges(mesh)) {
    poll_interruption_at(h.index());
    ComponentCounts& own = counts[component_of(h)];
    ++own.edges;
    own.boundary_edges += mesh.is_boundary(h) ? 1 : 0;
    own.nonmanifold_edges += mesh.is_nonmanifold(h) ? 1 : 0;
  }
  std::vector<VertexId> last_vertex(components.count);
  for (const VertexId v : vertices(mesh)) {
    poll_interruption_at(v.index());
    for (const HalfedgeId fan : mesh.fans(v)) {
      const std::uint32_t component = component_of(fan);
      ++counts[component].fans;
      counts[component].vertices += last_vertex[component] != v ? 1 : 0;
      last_vertex[component] = v;
    }
  }
  return counts;
}

Maybe<std::int64_t> genus_from(const ComponentCounts& counts) {
  const std::int64_t extra_fans = counts.fans - counts.vertices;
  if (counts.nonmanifold_edges != 0)
    return Undefined{fmt::format("no genus: non-manifold edges: {}", counts.nonmanifold_edges)};
  if (counts.boundary_edges != 0) return Undefined{fmt::format("no genus: boundary edges: {}", counts.boundary_edges)};
  if (extra_fans != 0)
    return Undefined{fmt::format("no genus: vertices where the surface touches itself: {}", extra_fans)};
  return 1 - (counts.vertices - counts.edges + counts.faces) / 2;
}

/// Calls visit(other) for half-edges that share the edge of `h`. Only the first along a non-manifold edge sees all the
/// others, these see the first: enough to connect them, and linear.
template <typename Layout, typename Visit>
void for_each_link(const HalfedgeMesh<Layout>& mesh, HalfedgeId h, Visit visit) {
  if (!mesh.is_nonmanifold(h)) {
    if (const HalfedgeId other = mesh.opposite(h); other.is_valid()) visit(other);
    return;
  }
  const auto along = mesh.edge_halfedges(h);
  if (along.front() != h) return visit(along.front());
  for (const HalfedgeId other : along) visit(other);
}

/// The boundary half-edge that follows boundary half-edge `h` round the same fan; invalid if the fan ends on a
/// non-manifold edge.
template <typename Layout>
HalfedgeId next_on_boundary(const HalfedgeMesh<Layout>& mesh, HalfedgeId h) {
  HalfedgeId leaving = mesh.next(h);
  for (HalfedgeId other = mesh.opposite(leaving); other.is_valid(); other = mesh.opposite(leaving))
    leaving = mesh.next(other);
  return mesh.is_boundary(leaving) ? leaving : HalfedgeId();
}

}  // namespace

std::vector<std::vector<FaceId>> FaceComponents::faces() const {
  std::vector<std::vector<FaceId>> result(count);
  for (std::size_t f = 0; f < of_face.size(); ++f) result[of_face[f]].emplace_back(f);
  return result;
}

template <typename Layout>
FaceComponents connected_components(const HalfedgeMesh<Layout>& mesh) {
  FaceComponents components{std::vector<std::uint32_t>(mesh.face_count(), kNone), 0};
  std::vector<FaceId> pending;
  for (const FaceId seed : faces(mesh)) {
    poll_interruption_at(seed.index());
    if (components.of_face[seed.index()] != kNone) continue;
    const auto number = static_cast<std::uint32_t>(components.count++);
    const auto enter = [&](FaceId f) {
      if (components.of_face[f.index()] != kNone) return;
      components.of_face[f.index()] = number;
      pending.push_back(f);
    };
    enter(seed);
    while (!pending.empty()) {
      const FaceId f = pending.back();
      pending.pop_back();
      for (const HalfedgeId h : halfedges_of(mesh, f))
        for_each_link(mesh, h, [&](HalfedgeId other) { enter(mesh.face(other)); });
    }
  }
  return components;
}

template <typename Layout>
std::vector<BoundaryLoop> boundary_loops(const HalfedgeMesh<Layout>& mesh) {
  // Runs that are not closed must be entered at their start: at the half-edges that follow no other.
  std::vector<bool> follows(mesh.halfedge_count(), false);
  for (const HalfedgeId h : halfedges(mesh)) {
    poll_interruption_at(h.index());
    if (!mesh.is_boundary(h)) continue;
    if (const HalfedgeId next = next_on_boundary(mesh, h); next.is_valid()) follows[next.index()] = true;
  }
  std::vector<bool> is_done(mesh.halfedge_count(), false);
  std::vector<BoundaryLoop> loops;
  for (const bool closed : {false, true}) {
    for (const HalfedgeId first : halfedges(mesh)) {
      poll_interruption_at(first.index());
      if (!mesh.is_boundary(first) || is_done[first.index()] || (!closed && follows[first.index()])) continue;
      BoundaryLoop& loop = loops.emplace_back();
      loop.is_closed = closed;
      for (HalfedgeId h = first; h.is_valid() && !is_done[h.index()]; h = next_on_boundary(mesh, h)) {
        is_done[h.index()] = true;
        loop.halfedges.push_back(h);
      }
    }
  }
  std::ranges::sort(loops, {}, [](const BoundaryLoop& loop) { return loop.halfedges.front(); });
  return loops;
}

template <typename Layout>
std::size_t edge_count(const HalfedgeMesh<Layout>& mesh) {
  return static_cast<std::size_t>(std::ranges::distance(edges(mesh)));
}

template <typename Layout>
std::int64_t euler_characteristic(const HalfedgeMesh<Layout>& mesh) {
  const auto used = std::ranges::count_if(vertices(mesh), [&](VertexId v) { return !mesh.is_isolated(v); });
  return used - static_cast<std::int64_t>(edge_count(mesh)) + static_cast<std::int64_t>(mesh.face_count());
}

template <typename Layout>
bool is_closed(const HalfedgeMesh<Layout>& mesh) {
  return std::ranges::none_of(halfedges(mesh), [&](HalfedgeId h) { return mesh.is_boundary(h); });
}

template <typename Layout>
bool is_manifold(const HalfedgeMesh<Layout>& mesh) {
  return mesh.nonmanifold_edge_count() == 0 && mesh.nonmanifold_vertices().empty();
}

template <typename Layout>
bool is_balanced(const HalfedgeMesh<Layout>& mesh, std::span<const HalfedgeId> edge) {
  const auto forward =
      std::ranges::count_if(edge, [&](HalfedgeId h) { return mesh.origin(h) == mesh.origin(edge[0]); });
  return 2 * static_cast<std::size_t>(forward) == edge.size();
}

template <typename Layout>
bool is_consistently_oriented(const HalfedgeMesh<Layout>& mesh) {
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n) {
    std::int64_t balance = 0;
    for (const HalfedgeId h : mesh.nonmanifold_edge(n)) {
      balance += mesh.origin(h) < mesh.target(h) ? 1 : 0;
      balance -= mesh.target(h) < mesh.origin(h) ? 1 : 0;
    }
    if (balance != 0) return false;
  }
  return true;
}

template <typename Layout>
Maybe<std::int64_t> genus(const HalfedgeMesh<Layout>& mesh) {
  const FaceComponents components = connected_components(mesh);
  ComponentCounts total;
  for (const ComponentCounts& part : count_elements(mesh, components)) {
    total.edges += part.edges;
    total.faces += part.faces;
    total.fans += part.fans;
    total.boundary_edges += part.boundary_edges;
    total.nonmanifold_edges += part.nonmanifold_edges;
  }
  // Here a vertex is one even if components meet in it: that is where the mesh touches itself.
  total.vertices = std::ranges::count_if(vertices(mesh), [&](VertexId v) { return !mesh.is_isolated(v); });
  Maybe<std::int64_t> connected = genus_from(total);
  if (!connected) return connected;
  return *connected + static_cast<std::int64_t>(components.count) - 1;
}

template <typename Layout>
std::vector<Maybe<std::int64_t>> component_genus(const HalfedgeMesh<Layout>& mesh, const FaceComponents& components) {
  std::vector<Maybe<std::int64_t>> result;
  result.reserve(components.count);
  for (const ComponentCounts& counts : count_elements(mesh, components)) result.push_back(genus_from(counts));
  return result;
}

template FaceComponents connected_components(const HalfedgeMesh<TriangleLayout>&);
template std::vector<BoundaryLoop> boundary_loops(const HalfedgeMesh<TriangleLayout>&);
template std::size_t edge_count(const HalfedgeMesh<TriangleLayout>&);
template std::int64_t euler_characteristic(const HalfedgeMesh<TriangleLayout>&);
template bool is_closed(const HalfedgeMesh<TriangleLayout>&);
template bool is_manifold(const HalfedgeMesh<TriangleLayout>&);
template bool is_balanced(const HalfedgeMesh<TriangleLayout>&, std::span<const HalfedgeId>);
template bool is_consistently_oriented(const HalfedgeMesh<TriangleLayout>&);
template Maybe<std::int64_t> genus(const HalfedgeMesh<TriangleLayout>&);
template std::vector<Maybe<std::int64_t>> component_genus(const HalfedgeMesh<TriangleLayout>&, const FaceComponents&);
template FaceComponents connected_components(const HalfedgeMesh<PolygonLayout>&);
template std::vector<BoundaryLoop> boundary_loops(const HalfedgeMesh<PolygonLayout>&);
template std::size_t edge_count(const HalfedgeMesh<PolygonLayout>&);
template std::int64_t euler_characteristic(const HalfedgeMesh<PolygonLayout>&);
template bool is_closed(const HalfedgeMesh<PolygonLayout>&);
template bool is_manifold(const HalfedgeMesh<PolygonLayout>&);
template bool is_balanced(const HalfedgeMesh<PolygonLayout>&, std::span<const HalfedgeId>);
template bool is_consistently_oriented(const HalfedgeMesh<PolygonLayout>&);
template Maybe<std::int64_t> genus(const HalfedgeMesh<PolygonLayout>&);
template std::vector<Maybe<std::int64_t>> component_genus(const HalfedgeMesh<PolygonLayout>&, const FaceComponents&);

namespace {

/// One triangle at an edge, as someone sees it who looks along the edge.
struct Wing {
  VertexId apex;
  bool is_forward;
};

}  // namespace

EdgeOrder order_around(const TriangleMesh& mesh, std::span<const HalfedgeId> edge) {
  const VertexId from = mesh.origin(edge[0]), to = mesh.target(edge[0]);
  std::vector<Wing> wings;
  for (const HalfedgeId h : edge) wings.push_back({mesh.origin(TriangleMesh::prev(h)), mesh.origin(h) == from});
  const VertexId start = wings[0].apex;
  const auto order = [&](const Wing& a, const Wing& b) {
    return compare_around_edge(mesh.point(from), mesh.point(to), mesh.point(start), mesh.point(a.apex),
                               mesh.point(b.apex));
  };
  std::ranges::stable_sort(wings, [&](const Wing& a, const Wing& b) { return std::is_lt(order(a, b)); });
  bool alternates = true;
  for (std::size_t i = 0; i < wings.size(); ++i) {
    const Wing& next = wings[i + 1 == wings.size() ? 0 : i + 1];
    if (std::is_eq(order(wings[i], next))) return EdgeOrder::overlapping;
    alternates = alternates && wings[i].is_forward != next.is_forward;
  }
  return alternates ? EdgeOrder::alternating : EdgeOrder::mixed;
}

TriangleMesh flipped(const TriangleMesh& mesh) {
  std::vector<TriangleMesh::Triangle> triangles;
  triangles.reserve(mesh.face_count());
  for (const FaceId f : faces(mesh)) {
    poll_interruption_at(f.index());
    const auto [a, b, c] = mesh.triangle(f);
    triangles.push_back({a, c, b});
  }
  return {mesh.points(), triangles};
}

SubmeshMaker::SubmeshMaker(const TriangleMesh& mesh)
    : mesh_(mesh), vertices_(mesh.vertex_count(), kNone), planes_(mesh.planes().size(), kNone) {}

FacePlanes SubmeshMaker::planes_of(std::span<const FaceId> faces) {
  const FacePlanes& planes = mesh_.planes();
  FacePlanes result;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const std::uint32_t number = planes.number(faces[i].index());
    if (number == kNone) continue;
    if (planes_[number] == kNone) planes_[number] = result.add(planes[number]);
    result.set(i, planes_[number]);
  }
  for (const FaceId face : faces)
    if (const std::uint32_t number = planes.number(face.index()); number != kNone) planes_[number] = kNone;
  return result;
}

TriangleMesh SubmeshMaker::make(std::span<const FaceId> faces) {
  std::vector<TriangleMesh::Triangle> triangles;
  triangles.reserve(faces.size());
  PointArray points;
  for (const FaceId f : faces) {
    poll_interruption_at(f.index());
    TriangleMesh::Triangle triangle = mesh_.triangle(f);
    for (std::uint32_t& corner : triangle) {
      if (vertices_[corner] == kNone) {
        vertices_[corner] = static_cast<std::uint32_t>(points.size());
        points.push_back(mesh_.points()[corner]);
      }
      corner = vertices_[corner];
    }
    triangles.push_back(triangle);
  }
  for (const FaceId f : faces)
    for (const std::uint32_t corner : mesh_.triangle(f)) vertices_[corner] = kNone;
  // Taking over links costs a look at all faces.
  if (faces.size() < mesh_.face_count() / 4) return {std::move(points), triangles, planes_of(faces)};
  std::vector<std::uint32_t> was(faces.size());
  std::ranges::transform(faces, was.begin(), [](FaceId face) { return face.index(); });
  return relinked(mesh_, std::move(was), std::move(points), triangles, planes_of(faces));
}

TriangleMesh submesh(const TriangleMesh& mesh, std::span<const FaceId> faces) {
  return SubmeshMaker(mesh).make(faces);
}

}  // namespace algebra3d
