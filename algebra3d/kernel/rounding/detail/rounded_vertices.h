#pragma once

#include <cstddef>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/rounding/detail/moved_points.h"

namespace algebra3d {

/// The vertices of a mesh, rounded to a grid.
struct RoundedVertices : MovedVertices {
  std::size_t moved = 0;        ///< how many moved
  double largest_movement = 0;  ///< upper bound of how far any vertex moved, in coordinate units
  bool are_finite = true;       ///< otherwise a coordinate is out of range, and all else means nothing
};

/// An upper bound of the distance between a point and the doubles to which it is rounded; 0 if they are equal.
double distance_to_rounded(const PointRef& point, const Vec3& rounded);

/// One flag per vertex: whether rounding moves it. Cost: a few nanoseconds per vertex.
std::vector<bool> are_moved(const TriangleMesh& mesh, const CoordinateGrid& grid);

/// Rounds all vertices. Movements are upper bounds. Cost: linear.
RoundedVertices rounded_vertices(const TriangleMesh& mesh, const CoordinateGrid& grid);

/// One flag per face: whether a corner of it moved. `movements`: a number per vertex, 0 if it stayed.
std::vector<bool> faces_that_move(const TriangleMesh& mesh, const std::vector<double>& movements);

/// True if no moved vertex has come to the place of another one. Cost: linear.
bool are_apart(const RoundedVertices& vertices);

/// The length slightly enlarged: an upper bound in spite of a few roundings.
double rounded_up(double length);

}  // namespace algebra3d
