#include "algebra3d/values/types/detail/geometry.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/soup/weld.h"
#include "algebra3d/values/types/coordinate_text.h"
#include "algebra3d/values/types/described_type.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

using Triangle = TriangleMesh::Triangle;

Result<std::array<ExactPoint, 3>> corners_from_nested(const NestedList& list, std::string_view what) {
  if (!list.is_list() || list.elements().size() != 3)
    return Error{ErrorCode::invalid_value, "{}: expected (p1 p2 p3), got {}", what, list.print_short()};
  std::array<ExactPoint, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    A3D_ASSIGN(corners[i], point_from_nested(list.elements()[i], what));
  }
  return corners;
}

std::strong_ordering compare_boxes(const Box3& a, const Box3& b) {
  for (const auto& [p, q] : {std::pair{a.min, b.min}, std::pair{a.max, b.max}})
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (const auto order = compare_reals(p[axis], q[axis]); std::is_neq(order)) return order;
  return std::strong_ordering::equal;
}

/// The box of vertices that are not isolated, of those from `begin` to `end`.
Box3 box_of_used(const TriangleMesh& mesh, std::size_t begin, std::size_t end) {
  Box3 box;
  for (std::size_t v = begin; v < end; ++v) {
    if (mesh.is_isolated(VertexId(v))) continue;
    const PointRef point = mesh.point(VertexId(v));
    if (point.is_double())
      box.extend(point.approx);
    else
      box.extend(box_of(point));
  }
  return box;
}

}  // namespace

const BoxHierarchy& Geometry::hierarchy() const {
  std::call_once(hierarchy_once_, [this] { hierarchy_ = std::make_unique<const BoxHierarchy>(mesh); });
  return *hierarchy_;
}

const EdgeComponents& Geometry::components() const {
  std::call_once(components_once_, [this] { components_ = std::make_unique<const EdgeComponents>(mesh); });
  return *components_;
}

const EdgeNumbers& Geometry::edge_numbers() const {
  std::call_once(edge_numbers_once_, [this] { edge_numbers_ = std::make_unique<const EdgeNumbers>(mesh); });
  return *edge_numbers_;
}

const SolidCells* Geometry::cells_after(std::size_t points, const SolidCells::AreInside& are_inside) const {
  // Making the cells costs as much as locating a point without them for every tenth of them.
  constexpr std::size_t kFewest = 4096, kMost = std::size_t{1} << 21U, kFacesForAPoint = 8;
  const std::size_t located = points_located_.fetch_add(points, std::memory_order_relaxed) + points;
  if (located * kFacesForAPoint < mesh.face_count() + kFewest) return nullptr;
  std::call_once(cells_once_, [&] {
    cells_ = SolidCells::make(mesh, box, std::clamp(2 * mesh.face_count(), kFewest, kMost), are_inside);
  });
  return cells_.get();
}

std::shared_ptr<const Geometry> make_geometry(TriangleMesh mesh) {
  constexpr std::size_t kVerticesPerTask = 20000;
  std::vector<Box3> boxes((mesh.vertex_count() + kVerticesPerTask - 1) / kVerticesPerTask);
  parallel_for(boxes.size(), 1, [&](std::size_t task) {
    const std::size_t end = std::min(mesh.vertex_count(), (task + 1) * kVerticesPerTask);
    boxes[task] = box_of_used(mesh, task * kVerticesPerTask, end);
  });
  Box3 box;
  for (const Box3& part : boxes) box.extend(part);
  return std::make_shared<const Geometry>(std::move(mesh), box);
}

Result<TriangleMesh> mesh_from_nested(const NestedList& list, std::string_view type_name) {
  if (!list.is_list())
    return Error{ErrorCode::invalid_value, "{}: expected a list of triangles, got {}", type_name, list.print_short()};
  if (list.elements().size() > TriangleMesh::kMaxFaces)
    return Error{ErrorCode::limit_exceeded, "{}: expected at most {} triangles, got {}", type_name,
                 TriangleMesh::kMaxFaces, list.elements().size()};
  std::vector<std::array<ExactPoint, 3>> corners;
  corners.reserve(list.elements().size());
  for (const NestedList& element : list.elements()) {
    poll_interruption_at(corners.size());
    A3D_ASSIGN(auto triangle,
               corners_from_nested(element, fmt::format("{}: triangle {}", type_name, corners.size() + 1)));
    corners.push_back(std::move(triangle));
  }
  WeldedTriangles welded = weld(corners);
  return TriangleMesh(std::move(welded.points), welded.triangles);
}

NestedList mesh_to_nested(const TriangleMesh& mesh) {
  NestedList::List triangles;
  triangles.reserve(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    const TriangleRef corners = mesh.corners(FaceId(f));
    triangles.push_back(
        NestedList::list(point_to_nested(corners[0]), point_to_nested(corners[1]), point_to_nested(corners[2])));
  }
  return NestedList(std::move(triangles));
}

void append_mesh_text(const TriangleMesh& mesh, std::string& text) {
  std::string points;
  std::vector<std::size_t> ends{0};
  ends.reserve(mesh.vertex_count() + 1);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    poll_interruption_at(v);
    point_to_nested(mesh.point(VertexId(v))).print_to(points);
    ends.push_back(points.size());
  }
  // A text of hundreds of megabytes is not moved while it grows: that cannot be interrupted.
  std::size_t size = 2;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    size += 5;
    for (const std::uint32_t v : mesh.triangle(FaceId(f))) size += ends[v + 1] - ends[v];
  }
  text.reserve(text.size() + size);
  text += '(';
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    text += f == 0 ? "(" : " (";
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t v = mesh.triangle(FaceId(f))[i];
      if (i > 0) text += ' ';
      text.append(points, ends[v], ends[v + 1] - ends[v]);
    }
    text += ')';
  }
  text += ')';
}

std::strong_ordering compare_point_sets(const Geometry& a, const Geometry& b, Orientation orientation) {
  if (&a == &b) return std::strong_ordering::equal;
  if (const auto order = compare_boxes(a.box, b.box); std::is_neq(order)) return order;
  const CanonicalFacets facets_a = canonical_facets(a.mesh, orientation);
  const CanonicalFacets facets_b = canonical_facets(b.mesh, orientation);
  const auto sizes = std::pair(facets_a.facet_count(), facets_a.segments.size()) <=>
                     std::pair(facets_b.facet_count(), facets_b.segments.size());
  if (std::is_neq(sizes)) return sizes;
  if (const auto order = facets_a.first_of_facet <=> facets_b.first_of_facet; std::is_neq(order)) return order;
  const PointArray &points_a = a.mesh.points(), &points_b = b.mesh.points();
  for (std::size_t s = 0; s < facets_a.segments.size(); ++s) {
    poll_interruption_at(s);
    const FacetSegment &p = facets_a.segments[s], &q = facets_b.segments[s];
    if (const auto order = compare(points_a[p.first], points_b[q.first]); std::is_neq(order)) return order;
    if (const auto order = compare(points_a[p.second], points_b[q.second]); std::is_neq(order)) return order;
  }
  return std::strong_ordering::equal;
}

std::size_t hash_point_set(const Geometry& geometry, Orientation orientation) {
  const auto hash_of = [&](std::uint32_t point) {
    // The rounded coordinates do: equal points have equal ones.
    const Vec3& p = geometry.mesh.points().approx()[point];
    return combine_hashes(combine_hashes(hash_real(p.x), hash_real(p.y)), hash_real(p.z));
  };
  const CanonicalFacets facets = canonical_facets(geometry.mesh, orientation);
  std::size_t hash = facets.facet_count();
  for (const auto& [from, to] : facets.segments) {
    poll_interruption();
    hash = combine_hashes(combine_hashes(hash, hash_of(from)), hash_of(to));
  }
  return hash;
}

bool has_equal_points(const TriangleMesh& mesh) {
  PointTable seen(mesh.vertex_count());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    poll_interruption_at(v);
    if (seen.intern(mesh.point(VertexId(v))) != v) return true;
  }
  return false;
}

}  // namespace algebra3d
