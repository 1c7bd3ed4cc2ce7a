#pragma once

#include <memory>
#include <optional>

#include "algebra3d/kernel/distance/distance.h"
#include "algebra3d/values/spatial_relations/relation.h"

namespace algebra3d {

/// The points, edges and triangles of a set as faces of a mesh: for a surface its own, for a solid or a box those of
/// the boundary; points are faces that repeat their corner. Refers to a surface or solid, and owns the mesh of other
/// sets.
class BoundaryFaces {
 public:
  explicit BoundaryFaces(const SpatialSet& set);

  DistanceOperand operand() const { return {mesh_, hierarchy_}; }

 private:
  void take(const PointSet& set);
  void take(const Box3& box);
  void take(const Surface3d& surface) { refer_to(surface.geometry()); }
  void take(const Volume3d& solid) { refer_to(solid.geometry()); }
  void refer_to(const Geometry& geometry);
  void own(TriangleMesh mesh);

  const TriangleMesh* mesh_ = nullptr;
  const BoxHierarchy* hierarchy_ = nullptr;
  std::unique_ptr<const TriangleMesh> own_mesh_;
  std::unique_ptr<const BoxHierarchy> own_hierarchy_;
};

}  // namespace algebra3d
