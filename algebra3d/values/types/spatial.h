#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/halfedge/edge_numbers.h"
#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/halfedge/edge_components.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/halfedge/vertex_facts.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "algebra3d/kernel/search/solid_cells.h"
#include "algebra3d/kernel/validity/validity.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d {

/// point3d: a position with exact coordinates.
struct Point3d {
  ExactPoint position;
};

/// vector3d: a direction with exact components.
struct Vector3d {
  ExactPoint components;
};
/// Undefined if a component is beyond the range of doubles.
Maybe<Vector3d> vector_of(const RationalVec3& components);

/// plane3d: the points x with x.n = c, exactly, oriented by n. Keeps the quadruple of doubles that it was given as, if
/// any. Two planes are equal if they have the same points and orientation.
struct Plane3d {
  ExactPlane plane;
  /// A point of the plane, as given or computed; printed with the normal if no quadruple of doubles is equal to the
  /// plane.
  RationalVec3 point;
  std::shared_ptr<const std::array<double, 4>> quadruple;  ///< d, nx, ny, nz as given; null for other planes
};

/// points3d: a set of points, in lexicographic order.
class Points3d {
 public:
  Points3d() = default;
  /// Sorts and drops duplicates. Cost: n log n, linear if sorted already.
  explicit Points3d(std::vector<ExactPoint> points);

  const std::vector<ExactPoint>& points() const { return *points_; }

 private:
  std::shared_ptr<const std::vector<ExactPoint>> points_ = std::make_shared<const std::vector<ExactPoint>>();
};

/// The triangles of a valid surface or volume, with their box, hierarchy and components. Immutable and shared.
struct Geometry {
  TriangleMesh mesh;
  Box3 box;  ///< outward-rounded; empty for the empty value

  Geometry(TriangleMesh triangles, const Box3& bounds) : mesh(std::move(triangles)), box(bounds) {}
  /// The hierarchy over all triangles, built at the first call, by any thread. Cost: linear at the first call.
  const BoxHierarchy& hierarchy() const;
  /// The components of the faces, found at the first call, likewise.
  const EdgeComponents& components() const;
  /// The numbers of the edges, likewise.
  const EdgeNumbers& edge_numbers() const;
  const HubFacts& hub_facts() const { return hub_facts_; }
  /// The cells of a solid in which so many more points are to be located; null until those so far are worth the cost of
  /// making them, and for a solid without (SolidCells::make). Made by one thread.
  const SolidCells* cells_after(std::size_t points, const SolidCells::AreInside& are_inside) const;

 private:
  mutable std::once_flag hierarchy_once_, components_once_, edge_numbers_once_, cells_once_;
  mutable std::unique_ptr<const BoxHierarchy> hierarchy_;
  mutable std::unique_ptr<const EdgeComponents> components_;
  mutable std::unique_ptr<const EdgeNumbers> edge_numbers_;
  mutable std::unique_ptr<const SolidCells> cells_;
  mutable std::atomic<std::size_t> points_located_ = 0;
  HubFacts hub_facts_;
};

/// surface3d: a surface without the defects of validity/report.h, valid by construction. Cheap to copy. Triangles keep
/// their order. Equal if they are the same point sets, whatever the triangles and their orientation.
class Surface3d {
 public:
  Surface3d();  ///< the empty surface
  /// Proves `mesh`; undefined, with the defects, if it is not a valid surface. Errors: interrupted.
  static Result<Maybe<Surface3d>> prove(TriangleMesh mesh, const ProofOptions& options = {});
  /// Takes `mesh` without a proof: for meshes that were proved before storing, and parts of proved values.
  static Surface3d trusted(TriangleMesh mesh);

  const TriangleMesh& mesh() const { return geometry_->mesh; }
  const Box3& box() const { return geometry_->box; }
  const Geometry& geometry() const { return *geometry_; }

 private:
  explicit Surface3d(std::shared_ptr<const Geometry> geometry) : geometry_(std::move(geometry)) {}
  std::shared_ptr<const Geometry> geometry_;
};

/// volume3d: a solid, valid by construction (validity/report.h) and oriented outward; may have cavities and several
/// bodies. Equal if they are the same point sets, whatever the triangles.
class Volume3d {
 public:
  Volume3d();  ///< the empty volume
  static Result<Maybe<Volume3d>> prove(TriangleMesh mesh, const ProofOptions& options = {});
  static Volume3d trusted(TriangleMesh mesh);

  const TriangleMesh& mesh() const { return geometry_->mesh; }
  const Box3& box() const { return geometry_->box; }
  const Geometry& geometry() const { return *geometry_; }

 private:
  explicit Volume3d(std::shared_ptr<const Geometry> geometry) : geometry_(std::move(geometry)) {}
  std::shared_ptr<const Geometry> geometry_;
};

/// The class of rect3 is Box3; a defined value is never an empty box.
template <>
struct TypeOf<Box3> {
  static const Type& type();
};
template <>
struct TypeOf<Point3d> {
  static const Type& type();
};
template <>
struct TypeOf<Points3d> {
  static const Type& type();
};
template <>
struct TypeOf<Vector3d> {
  static const Type& type();
};
template <>
struct TypeOf<Plane3d> {
  static const Type& type();
};
template <>
struct TypeOf<Surface3d> {
  static const Type& type();
};
template <>
struct TypeOf<Volume3d> {
  static const Type& type();
};

}  // namespace algebra3d
