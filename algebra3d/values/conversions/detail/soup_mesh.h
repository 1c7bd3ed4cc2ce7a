#pragma once

#include <utility>

#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "base/polygon_soup.h"

namespace algebra3d {

/// A mesh of the points and polygons in their order. Domain: at most PolygonMesh::kMaxHalfedges corners of faces.
inline PolygonMesh mesh_of_soup(PolygonSoup soup) {
  PolygonLayout layout({soup.face_starts.begin(), soup.face_starts.end()});
  return {PointArray(std::move(soup.points)), std::move(layout), {soup.corners.begin(), soup.corners.end()}};
}

}  // namespace algebra3d
