#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/halfedge/circulators.h"
#include "algebra3d/halfedge/edge_numbers.h"
#include "algebra3d/halfedge/halfedge_structure.h"
#include "algebra3d/mesh/attributes.h"

/// Half-edge meshes: the elements, their neighbourhoods and their attributes. What is done with meshes is in the other
/// headers of this folder; docs/mesh_library.md is the guide.
namespace algebra3d {

class MeshAttributes;  // private to the library

namespace mesh {

class TriangleMesh;
class PolygonMesh;

using algebra3d::EdgeId;
using algebra3d::FaceId;
using algebra3d::HalfedgeId;
using algebra3d::VertexId;

// The enumerators: see algebra3d/halfedge/circulators.h. Functions of meshes are also found without their namespace.
using algebra3d::adjacent_faces;
using algebra3d::adjacent_vertices;
using algebra3d::faces;
using algebra3d::faces_around;
using algebra3d::halfedges;
using algebra3d::halfedges_of;
using algebra3d::incoming_halfedges;
using algebra3d::outgoing_halfedges;
using algebra3d::vertices;
using algebra3d::vertices_of;

namespace detail {
struct MeshAccess;
template <typename Derived>
struct MeshContent;
}  // namespace detail

/// The arrays of a mesh, which belong to the content that its copies share.
struct SharedArrays {
  using Points = std::span<const Vec3>;
  using Numbers = std::span<const std::uint32_t>;
  using Handles = std::span<const HalfedgeId>;
  using Tables = const NonManifoldTables*;
};

/// The common base of TriangleMesh and PolygonMesh: vertices, edges and faces, numbered from 0, and half-edges, of
/// which those of a face are numbered consecutively. A half-edge has its face to the left; boundary edges have one.
/// Any list of faces is a mesh: it may be open, non-manifold, or have isolated vertices. Faces may be bent or cross.
///
/// Immutable and cheap to copy: copies share the arrays, which live as long as the last of them. Concurrent use is
/// safe. Handles that are passed must be those of elements of the mesh; ranges and iterators refer to the mesh object,
/// which must outlive them. Most members are those of HalfedgeStructure. Cost: constant and inline, where nothing else
/// is said.
///
/// Functions that can fail return a Result and do not throw: exhausted memory is the error out_of_memory. The others
/// throw only std::bad_alloc.
template <typename Derived, typename Layout>
class Mesh : public HalfedgeStructure<Layout, SharedArrays> {
  using Structure = HalfedgeStructure<Layout, SharedArrays>;

 public:
  // A moved-from mesh keeps its value: moving copies.
  Mesh(const Mesh&) = default;
  Mesh& operator=(const Mesh&) = default;
  ~Mesh() = default;

  std::size_t edge_count() const { return first_halfedges_.size(); }
  EdgeId edge(HalfedgeId h) const { return edge_numbers_->edge(first_along(*this, h)); }
  /// The first half-edge along an edge.
  HalfedgeId halfedge(EdgeId e) const { return first_halfedges_[e.index()]; }
  using Layout::halfedge;
  /// The ends of an edge: origin and target of its first half-edge.
  std::array<VertexId, 2> ends(EdgeId e) const {
    const HalfedgeId h = halfedge(e);
    return {this->origin(h), this->target(h)};
  }
  using Structure::is_boundary;
  bool is_boundary(EdgeId e) const { return is_boundary(halfedge(e)); }
  /// Whether an edge that has one face only ends in `v`. Cost: constant; linear in the faces of a non-manifold vertex.
  bool is_boundary(VertexId v) const {
    // A fan begins at the boundary if it has one; where edges are non-manifold it may begin at one of these.
    if (!is_nonmanifold(v)) return std::ranges::any_of(this->fans(v), [&](HalfedgeId h) { return is_boundary(h); });
    return std::ranges::any_of(outgoing_halfedges(*this, v),
                               [&](HalfedgeId h) { return is_boundary(h) || is_boundary(this->prev(h)); });
  }
  using Structure::is_nonmanifold;
  bool is_nonmanifold(EdgeId e) const { return is_nonmanifold(halfedge(e)); }
  /// The first half-edge from one vertex to another in the order of outgoing_halfedges; invalid if there is none. Cost:
  /// the number of faces at `from`.
  HalfedgeId find_halfedge(VertexId from, VertexId to) const {
    for (const HalfedgeId h : outgoing_halfedges(*this, from))
      if (this->target(h) == to) return h;
    return {};
  }

  /// The position of a vertex, each coordinate rounded to the nearest double if it is a fraction.
  const Vec3& point(VertexId v) const { return this->points()[v.index()]; }
  /// True if a coordinate is not a double: then `points` are rounded. Such meshes are made of exact solids and surfaces
  /// alone; conversions, edits and proofs use the exact coordinates.
  bool has_fractions() const;
  /// The vertices of all corners, one face after the other, by their numbers: no copy. Corner i is left by half-edge i.
  std::span<const std::uint32_t> corners() const { return this->origins(); }
  std::span<const std::uint32_t> corners(FaceId f) const {
    return corners().subspan(halfedge(f).index(), this->degree(f));
  }

  /// The kinds of attributes that the mesh has, sorted by element and name.
  std::vector<AttributeDescription> attributes() const;
  /// The values of an attribute of the elements that `Id` names: VertexId, EdgeId, HalfedgeId (also corners) or FaceId.
  /// `T` is double, Vec2, Vec3 or std::string. Errors: unknown_name; type_error if its values are others.
  template <typename Id, typename T>
  Result<Column<Id, T>> attribute(std::string_view name) const {
    ALGEBRA3D_ASSIGN_OR_RETURN(detail::ColumnContent content,
                               column(detail::element_of<Id>(), detail::kind_of<T>(), name));
    return Column<Id, T>(std::move(content));
  }
  /// The mesh with an attribute of the elements that `Id` names, in place of one with the same name: a value for each
  /// element, in order; numbers that are not finite mean *undefined*. The mesh is shared. Errors: invalid_value for a
  /// wrong number of values, or an empty name. Cost: linear in the values.
  template <typename Id>
  Result<Derived> with_attribute(std::string name, std::span<const double> values) const {
    return with_column(detail::element_of<Id>(), std::move(name), detail::ColumnValues{values});
  }
  template <typename Id>
  Result<Derived> with_attribute(std::string name, std::span<const Vec2> values) const {
    return with_column(detail::element_of<Id>(), std::move(name), detail::ColumnValues{values});
  }
  template <typename Id>
  Result<Derived> with_attribute(std::string name, std::span<const Vec3> values) const {
    return with_column(detail::element_of<Id>(), std::move(name), detail::ColumnValues{values});
  }
  template <typename Id>
  Result<Derived> with_attribute(std::string name, std::span<const std::string> values) const {
    return with_column(detail::element_of<Id>(), std::move(name), detail::ColumnValues{values});
  }
  /// The mesh without an attribute, if there is one of this name.
  template <typename Id>
  Derived without_attribute(std::string_view name) const {
    return without_column(detail::element_of<Id>(), name);
  }

 protected:
  Mesh() = default;  ///< the empty mesh

 private:
  friend struct detail::MeshAccess;

  Result<detail::ColumnContent> column(MeshElement element, AttributeKind kind, std::string_view name) const;
  Result<Derived> with_column(MeshElement element, std::string name, const detail::ColumnValues& values) const;
  Derived without_column(MeshElement element, std::string_view name) const;

  std::shared_ptr<const detail::MeshContent<Derived>> content_;  // null if empty
  std::shared_ptr<const MeshAttributes> attributes_;             // null if there are none
  std::span<const HalfedgeId> first_halfedges_;                  // per edge; of the content
  const EdgeNumbers* edge_numbers_ = nullptr;                    // of the content
};

/// The points of a new mesh: a range such as std::span or std::array, which is copied, or a vector that is handed over
/// by std::move, whose memory the mesh keeps; it is given up in any case. A range must live until the call ends.
class GivenPoints {
 public:
  GivenPoints() = default;  ///< none
  template <std::convertible_to<std::span<const Vec3>> Range>
  GivenPoints(const Range& points) : points_(points) {}
  GivenPoints(std::vector<Vec3>&& points) : owned_(std::move(points)), points_(owned_) {}
  GivenPoints(const GivenPoints&) = delete;
  GivenPoints& operator=(const GivenPoints&) = delete;
  ~GivenPoints() = default;

  std::span<const Vec3> span() const { return points_; }
  /// The points as a vector, once. Cost: constant if they were handed over, else a copy.
  std::vector<Vec3> take() {
    return owned_.empty() ? std::vector<Vec3>(points_.begin(), points_.end()) : std::move(owned_);
  }

 private:
  std::vector<Vec3> owned_;
  std::span<const Vec3> points_;
};

/// A mesh of triangles as directed edges: half-edge 3f + i leaves corner i of face f. Source: [campagna1998].
class TriangleMesh : public Mesh<TriangleMesh, TriangleLayout> {
 public:
  TriangleMesh() = default;  ///< the empty mesh

  /// A mesh of points and triangles, numbered in their order; nothing is welded, and points that no triangle uses are
  /// isolated vertices. The arrays are copied, but for points that are handed over. Errors: invalid_value for
  /// coordinates that are not finite, for numbers of points that are not there, and for a number of corners that is not
  /// a multiple of 3; limit_exceeded beyond some 700 million triangles. Cost: linear expected.
  static Result<TriangleMesh> of_triangles(GivenPoints points, std::span<const std::array<std::uint32_t, 3>> triangles);
  static Result<TriangleMesh> of_corners(GivenPoints points, std::span<const std::uint32_t> corners);

  std::array<std::uint32_t, 3> triangle(FaceId f) const {
    const std::uint32_t* const first = corners().data() + halfedge(f).index();
    return {first[0], first[1], first[2]};
  }
};

/// The faces of a mesh of polygons, by arrays that it shares.
using SharedPolygonLayout = PolygonLayoutIn<std::span<const std::uint32_t>>;

/// A mesh of polygons with three or more corners each; faces of any degree may stand beside each other.
class PolygonMesh : public Mesh<PolygonMesh, SharedPolygonLayout> {
 public:
  PolygonMesh() = default;  ///< the empty mesh
  /// The same elements and attributes. Cost: linear.
  explicit PolygonMesh(const TriangleMesh& triangles);

  /// A mesh of points and faces, numbered in their order: the corners of all faces one after the other, and how many
  /// each face has. Nothing is welded, and points that no face uses are isolated vertices. The arrays are copied, but
  /// for points that are handed over. Errors: invalid_value for coordinates that are not finite, for numbers of points
  /// that are not there, for degrees below 3 and for those whose sum is not the number of corners; limit_exceeded
  /// beyond some 2 billion corners. Cost: linear expected.
  static Result<PolygonMesh> of_faces(GivenPoints points, std::span<const std::uint32_t> corners,
                                      std::span<const std::uint32_t> degrees);
  /// The same for faces of one degree.
  static Result<PolygonMesh> of_faces(GivenPoints points, std::span<const std::uint32_t> corners, std::uint32_t degree);
};

extern template class Mesh<TriangleMesh, TriangleLayout>;
extern template class Mesh<PolygonMesh, SharedPolygonLayout>;

/// TriangleMesh or PolygonMesh: what functions of both kinds of meshes take.
template <typename T>
concept AnyMesh = std::same_as<T, TriangleMesh> || std::same_as<T, PolygonMesh>;

/// All edges, ascending. Random access.
template <AnyMesh M>
HandleRange<EdgeId> edges(const M& mesh) {
  return {0, mesh.edge_count()};
}

}  // namespace mesh
}  // namespace algebra3d
