#include "algebra3d/kernel/arrangement/detail/plane_triangle.h"

#include <algorithm>

#include "algebra3d/kernel/exact/counters.h"

namespace algebra3d::arrangement {

bool has_exact_corner(const TriangleRef& triangle) {
  return !std::ranges::all_of(triangle, &PointRef::is_double);
}

PlaneTriangle::PlaneTriangle(const TriangleRef& corners, const std::array<InputVertexId, 3>& vertices,
                             const IntegerPlane* plane)
    : corners_(corners), vertices_(vertices), plane_(plane) {
  if (plane_ != nullptr)
    rounded_ = plane_->rounded();
  else if (!has_exact_corner(corners_))
    filter_.emplace(corners_[0].approx, corners_[1].approx, corners_[2].approx);
}

Signs PlaneTriangle::rounded_sides(const TriangleRef& points) const {
  detail::count_calls(3);
  Signs signs{detail::kUndecided, detail::kUndecided, detail::kUndecided};
  if (plane_ != nullptr) {
    for (std::size_t i = 0; i < 3; ++i) signs[i] = detail::filter_rounded_side(rounded_, points[i].approx);
  } else if (filter_) {
    for (std::size_t i = 0; i < 3; ++i)
      if (points[i].is_double()) signs[i] = filter_->side(points[i].approx);
  }
  return signs;
}

int PlaneTriangle::exact_side(const PointRef& point) const {
  const auto& [a, b, c] = corners_;
  if (plane_ != nullptr) return plane_->side(point);
  return filter_ && point.is_double() ? detail::decide_orient3d(a.approx, b.approx, c.approx, point.approx)
                                      : orient3d(a, b, c, point);
}

}  // namespace algebra3d::arrangement
