#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/values/display/shape.h"
#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/spatial.h"

/// Shapes of values without a mesh; see shape_of. Errors: limit_exceeded, of regions also interrupted.
namespace algebra3d::detail {

Result<DrawnShape> shape_of_point(const Point3d& point);
Result<DrawnShape> shape_of_points(const Points3d& points);
Result<DrawnShape> shape_of_vector(const Vector3d& vector);
Result<DrawnShape> shape_of_plane(const Plane3d& plane);
Result<DrawnShape> shape_of_box(const Box3& box);
Result<DrawnShape> shape_of_point_in_plane(const Point2d& point);
Result<DrawnShape> shape_of_rect(const Rect& rect);
Result<DrawnShape> shape_of_region(const Region& region, const Monitor& monitor);

}  // namespace algebra3d::detail
