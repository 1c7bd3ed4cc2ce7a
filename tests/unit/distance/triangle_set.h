#pragma once

#include <vector>

#include "algebra3d/kernel/distance/distance.h"

namespace algebra3d {

/// A set of triangles with its hierarchy.
struct TriangleSet {
  TriangleMesh mesh;
  BoxHierarchy hierarchy;

  TriangleSet(std::vector<Vec3> points, std::vector<TriangleMesh::Triangle> triangles)
      : mesh(PointArray(std::move(points)), triangles), hierarchy(mesh) {}
  DistanceOperand operand() const { return {&mesh, &hierarchy}; }
};

}  // namespace algebra3d
