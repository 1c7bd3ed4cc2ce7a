#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/display/shape.h"
#include "algebra3d/types/planar.h"
#include "algebra3d/types/spatial.h"

/// Shapes of values without a mesh; see shape_of. Errors: limit_exceeded, of regions also interrupted.
namespace algebra3d::detail {

Result<Shape> shape_of_point(const Point3d& point);
Result<Shape> shape_of_points(const Points3d& points);
Result<Shape> shape_of_vector(const Vector3d& vector);
Result<Shape> shape_of_plane(const Plane3d& plane);
Result<Shape> shape_of_box(const Box3& box);
Result<Shape> shape_of_point_in_plane(const Point2d& point);
Result<Shape> shape_of_rect(const Rect& rect);
Result<Shape> shape_of_region(const Region& region, const Monitor& monitor);

}  // namespace algebra3d::detail
