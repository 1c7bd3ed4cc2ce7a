#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/search/box_hierarchy.h"

namespace algebra3d {

/// Point-in-solid queries, by winding numbers. Exact.
class InsideTest {
 public:
  /// The solid is a valid volume, and must outlive this.
  explicit InsideTest(const TriangleMesh& solid);

  /// True if the point lies inside. On the boundary the result is unspecified. Cost: that of a vertical ray.
  bool is_inside(const Vec3& point) const;
  /// One answer for each point, as above. Errors: interrupted. Cost: for many points far less than one by one, since
  /// their rays go through the solid together.
  Result<std::vector<bool>> are_inside(std::span<const Vec3> points, const Monitor& monitor) const;

 private:
  Box3 ray_from(const Vec3& point, std::size_t axis) const;
  std::size_t axis_of_rays(std::span<const Vec3> points) const;
  bool is_inside_along(std::size_t axis, const Vec3& point) const;
  void look_upwards(std::span<const Vec3> points, const std::vector<std::size_t>& asked,
                    std::vector<bool>& answers) const;

  const TriangleMesh& solid_;
  BoxHierarchy hierarchy_;
};

}  // namespace algebra3d
