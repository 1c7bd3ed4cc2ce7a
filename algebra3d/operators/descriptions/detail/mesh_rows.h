#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/halfedge/edge_numbers.h"
#include "algebra3d/kernel/halfedge/adjacency.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/normals.h"
#include "algebra3d/kernel/halfedge/vertex_facts.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/operators/registry/rows.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/context.h"
#include "base/propagate.h"

// Elements of meshes as rows. A value is a surface3d, volume3d or mesh3d; rows keep a copy of it, which is cheap.

namespace algebra3d::detail {

using Number = std::int64_t;

/// Id, Position, Valence, Normal, Boundary, Manifold, Halfedge.
using VertexRows = Rows<Number, Point3d, Number, std::optional<Vector3d>, bool, bool, std::optional<Number>>;
/// Id, Start, End, Left, Right, Length, Angle, Boundary, Manifold, FaceCount, Halfedge, Opposite.
using EdgeRows = Rows<Number, Number, Number, Number, std::optional<Number>, std::optional<double>,
                      std::optional<double>, bool, bool, Number, Number, std::optional<Number>>;
/// Id, Origin, Target, Next, Previous, Opposite, Face, Edge.
using HalfedgeRows = Rows<Number, Number, Number, Number, Number, std::optional<Number>, Number, Number>;
/// Id, Degree, Area, Normal, Centroid, Halfedge.
using FaceRows = Rows<Number, Number, std::optional<double>, std::optional<Vector3d>, Point3d, Number>;

inline const EdgeNumbers& edge_numbers_of(const Mesh3d& value) {
  return value.edge_numbers();
}
template <typename T>
const EdgeNumbers& edge_numbers_of(const T& value) {
  return value.geometry().edge_numbers();
}

inline const HubFacts& hub_facts_of(const Mesh3d& value) {
  return value.hub_facts();
}
template <typename T>
const HubFacts& hub_facts_of(const T& value) {
  return value.geometry().hub_facts();
}

template <typename Id>
std::optional<Number> number_if_valid(Id id) {
  return id.is_valid() ? std::optional(Number{id.index()}) : std::nullopt;
}
inline std::optional<Vector3d> vector_unless_zero(const Vec3& v) {
  return v == Vec3{} ? std::nullopt : std::optional(Vector3d{ExactPoint(v)});
}
/// Nothing beyond the range of doubles.
inline std::optional<double> number_if_finite(double number) {
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

// ---- the cells of an element

template <typename Layout>
VertexRows::Cells vertex_cells(const HalfedgeMesh<Layout>& mesh, VertexId v, const VertexFacts& facts) {
  return {Number{v.index()},
          Point3d{ExactPoint(mesh.point(v))},
          static_cast<Number>(facts.valence),
          vector_unless_zero(facts.normal),
          facts.is_boundary,
          mesh.fans(v).size() <= 1,
          number_if_valid(mesh.outgoing(v))};
}

/// `h` is the first half-edge of the edge.
template <typename Layout>
EdgeRows::Cells edge_cells(const HalfedgeMesh<Layout>& mesh, EdgeId edge, HalfedgeId h) {
  const VertexId start = mesh.origin(h), end = mesh.target(h);
  const HalfedgeId opposite = mesh.opposite(h);
  const bool has_two = opposite.is_valid() && mesh.face(opposite) != mesh.face(h);
  const std::size_t along = mesh.is_nonmanifold(h) ? faces_along(mesh, h).size() : has_two ? 2 : 1;
  return {Number{edge.index()},
          Number{start.index()},
          Number{end.index()},
          Number{mesh.face(h).index()},
          opposite.is_valid() ? std::optional(Number{mesh.face(opposite).index()}) : std::nullopt,
          number_if_finite(nearest_distance(mesh.point(start), mesh.point(end))),
          dihedral_angle_degrees(mesh, h),
          mesh.is_boundary(h),
          opposite.is_valid(),
          static_cast<Number>(along),
          Number{h.index()},
          number_if_valid(opposite)};
}

template <typename T>
HalfedgeRows::Cells halfedge_cells(const T& value, HalfedgeId h) {
  const auto& mesh = value.mesh();
  return {Number{h.index()},
          Number{mesh.origin(h).index()},
          Number{mesh.target(h).index()},
          Number{mesh.next(h).index()},
          Number{mesh.prev(h).index()},
          number_if_valid(mesh.opposite(h)),
          Number{mesh.face(h).index()},
          Number{edge_numbers_of(value).edge(first_along(mesh, h)).index()}};
}

template <typename Layout>
FaceRows::Cells face_cells(const HalfedgeMesh<Layout>& mesh, FaceId f) {
  const VectorArea measures = vector_area(mesh, f);
  return {Number{f.index()},
          Number{mesh.degree(f)},
          number_if_finite(measures.area),
          vector_unless_zero(measures.normal),
          Point3d{ExactPoint(nearest_mean(mesh.points(), corner_indices(mesh, f)))},
          Number{mesh.halfedge(f).index()}};
}

// ---- rows made one by one

/// Polls for an interruption from time to time.
inline Status check_sometimes(const Context& context, std::size_t step) {
  constexpr std::size_t kStepsBetweenChecks = 1024;
  return step % kStepsBetweenChecks == 0 ? context.check_cancelled() : Status();
}

/// The rows of the elements 0 to count - 1: cells(i) is called when row i is asked for.
template <typename RowsType, typename Cells>
RowsType rows_up_to(std::size_t count, Cells cells) {
  using Next = Result<std::optional<typename RowsType::Cells>>;
  return RowsType(count, [count, cells = std::move(cells), next = std::size_t{0}](Context& context) mutable -> Next {
    if (next == count) return Next(std::nullopt);
    A3D_TRY(check_sometimes(context, next));
    return Next(cells(next++));
  });
}

/// As `rows_up_to`, for elements of a value that is loaded when the first row is asked for: the rows are those of
/// cells_of(value), which makes the cells.
template <typename RowsType, typename T, typename CellsOf>
RowsType rows_of_loaded(std::size_t count, const OnDemand<T>& given, CellsOf cells_of) {
  using Next = Result<std::optional<typename RowsType::Cells>>;
  using Cells = decltype(cells_of(std::declval<const T&>()));
  return RowsType(count,
                  [count, value = given.value(), cells_of, cells = std::shared_ptr<Cells>(),
                   next = std::size_t{0}](Context& context) mutable -> Next {
                    if (next == count) return Next(std::nullopt);
                    A3D_TRY(check_sometimes(context, next));
                    if (cells == nullptr) {
                      A3D_ASSIGN(const T loaded, OnDemand<T>(value).load());
                      cells = std::make_shared<Cells>(cells_of(loaded));
                    }
                    return Next((*cells)(next++));
                  });
}

/// The rows of the listed elements of a value.
template <typename T>
VertexRows vertex_rows(const T& value, std::vector<VertexId> vertices) {
  const std::size_t count = vertices.size();
  return rows_up_to<VertexRows>(count, [value, vertices = std::move(vertices)](std::size_t i) {
    return vertex_cells(value.mesh(), vertices[i], hub_facts_of(value).of(value.mesh(), vertices[i]));
  });
}
/// Edges by their first half-edges.
template <typename T>
EdgeRows edge_rows(const T& value, std::vector<HalfedgeId> edges) {
  const std::size_t count = edges.size();
  return rows_up_to<EdgeRows>(count, [value, edges = std::move(edges)](std::size_t i) {
    return edge_cells(value.mesh(), edge_numbers_of(value).edge(edges[i]), edges[i]);
  });
}
template <typename T>
HalfedgeRows halfedge_rows(const T& value, std::vector<HalfedgeId> halfedges) {
  const std::size_t count = halfedges.size();
  return rows_up_to<HalfedgeRows>(
      count, [value, halfedges = std::move(halfedges)](std::size_t i) { return halfedge_cells(value, halfedges[i]); });
}
template <typename T>
FaceRows face_rows(const T& value, std::vector<FaceId> faces) {
  const std::size_t count = faces.size();
  return rows_up_to<FaceRows>(
      count, [value, faces = std::move(faces)](std::size_t i) { return face_cells(value.mesh(), faces[i]); });
}

/// The element with this number among `count`; undefined, with the reason, if there is none.
template <typename Id>
Maybe<Id> element(std::string_view kind, Number number, std::size_t count) {
  if (number >= 0 && static_cast<std::uint64_t>(number) < count) return Id(static_cast<std::size_t>(number));
  if (count == 0) return Undefined{fmt::format("there is no {} {}: the mesh is empty", kind, number)};
  return Undefined{fmt::format("there is no {0} {1}: expected a number from 0 to {2}", kind, number, count - 1)};
}

}  // namespace algebra3d::detail
