#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/exact/plane.h"
#include "algebra3d/exact/point.h"
#include "algebra3d/halfedge/box_hierarchy.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/types/value.h"
#include "algebra3d/validity/validity.h"

namespace algebra3d {

/// point3d: a position with exact coordinates.
struct Point3d {
  ExactPoint position;
};

/// vector3d: a direction with exact components.
struct Vector3d {
  ExactPoint components;
};

/// plane3d: the points x with x.n = c, exactly, oriented by n. Remembers the quadruple that it was written as, if it
/// was. Two planes are equal if they are the same points with the same orientation.
struct Plane3d {
  ExactPlane plane;
  /// A point of the plane, as given or found; printed with the normal where no quadruple of doubles says the same.
  RationalVec3 point;
  std::shared_ptr<const std::array<double, 4>> quadruple;  ///< d, nx, ny, nz as given; null if it came from elsewhere
};

/// points3d: a set of points, in lexicographic order, each once.
class Points3d {
 public:
  Points3d() = default;
  /// Sorts and drops duplicates. Cost: n log n, linear if sorted already.
  explicit Points3d(std::vector<ExactPoint> points);

  const std::vector<ExactPoint>& points() const { return *points_; }

 private:
  std::shared_ptr<const std::vector<ExactPoint>> points_ = std::make_shared<const std::vector<ExactPoint>>();
};

/// The triangles of a valid surface or volume, with what was computed once. Immutable and shared.
struct Geometry {
  TriangleMesh mesh;
  Box3 box;  ///< outward-rounded; empty for the empty value

  Geometry(TriangleMesh triangles, const Box3& bounds) : mesh(std::move(triangles)), box(bounds) {}
  /// Over all triangles; made when it is first asked for, by any thread. Cost: linear, the first time.
  const BoxHierarchy& hierarchy() const;

 private:
  mutable std::once_flag once_;
  mutable std::unique_ptr<const BoxHierarchy> hierarchy_;
};

/// surface3d: valid by construction (language.md 7.2). Cheap to copy. Triangles keep the order that they were given.
/// Equal means: the same points, whatever the triangles and their orientation.
class Surface3d {
 public:
  Surface3d();  ///< the empty surface
  /// Proves `mesh`; undefined with the defects named if it is no valid surface. Errors: interrupted.
  static Result<Maybe<Surface3d>> prove(TriangleMesh mesh, const ProofOptions& options = {});
  /// Takes `mesh` without a proof: for bytes that were proved before they were stored, and parts of proved values.
  static Surface3d trusted(TriangleMesh mesh);

  const TriangleMesh& mesh() const { return geometry_->mesh; }
  const Box3& box() const { return geometry_->box; }
  const Geometry& geometry() const { return *geometry_; }

 private:
  explicit Surface3d(std::shared_ptr<const Geometry> geometry) : geometry_(std::move(geometry)) {}
  std::shared_ptr<const Geometry> geometry_;
};

/// volume3d: a solid, valid by construction (language.md 7.2), oriented outward, cavities and several bodies included.
/// Equal means: the same points, whatever the triangles.
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

/// rect3 is Box3 itself; an empty box does not occur as a defined value.
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
