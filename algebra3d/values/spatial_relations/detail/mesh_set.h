#pragma once

#include "algebra3d/values/spatial_relations/point_location.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

/// A surface or solid that is not empty.
struct MeshSet {
  const Geometry* geometry;
  bool is_solid;

  const TriangleMesh& mesh() const { return geometry->mesh; }
  int dimension() const { return is_solid ? 3 : 2; }
  Placement place(PointRef point) const {
    return is_solid ? place_in_solid(point, *geometry) : place_on_surface(point, *geometry);
  }
};

}  // namespace algebra3d
