#include "algebra3d/geometry/shape.h"

#include <ostream>

#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "algebra3d/library/detail/surroundings.h"
#include "algebra3d/library/detail/triangles.h"
#include "algebra3d/library/shape_access.h"
#include "algebra3d/values/constructions/motions.h"
#include "algebra3d/values/types/codec.h"
#include "base/interruption_scope.h"
#include "base/nearest_rounding.h"
#include "base/propagate.h"
#include "base/without_exceptions.h"

// The analyzer does not follow how many values share an object.
// NOLINTBEGIN(clang-analyzer-cplusplus.NewDeleteLeaks,clang-analyzer-cplusplus.NewDelete)

namespace algebra3d {

using detail::check_finite;
using detail::defined;
using detail::ShapeAccess;
using detail::Surroundings;

template <typename Derived, typename Content>
Shape<Derived, Content>::Shape() : content_(std::make_shared<const Content>()) {}

template <typename Derived, typename Content>
Result<Derived> Shape<Derived, Content>::of_triangles(std::span<const Vec3> points,
                                                      std::span<const std::array<std::uint32_t, 3>> triangles,
                                                      const Monitor& monitor) {
  return without_exceptions([&]() -> Result<Derived> {
    const InterruptionScope interruption(monitor.cancel());
    return ShapeAccess::outer(detail::proved<Content>(points, triangles, monitor));
  });
}

template <typename Derived, typename Content>
Result<Derived> Shape<Derived, Content>::of_bytes(std::string_view bytes) {
  return without_exceptions([&]() -> Result<Derived> {
    A3D_ASSIGN(const Value value, detail::value_of_bytes(TypeOf<Content>::type(), bytes));
    return ShapeAccess::outer(value.get<Content>());
  });
}

template <typename Derived, typename Content>
Result<Derived> Shape<Derived, Content>::of_text(std::string_view text) {
  return without_exceptions([&]() -> Result<Derived> {
    A3D_ASSIGN(const Value value, detail::value_of_text(TypeOf<Content>::type(), text));
    return ShapeAccess::outer(value.get<Content>());
  });
}

template <typename Derived, typename Content>
std::size_t Shape<Derived, Content>::triangle_count() const {
  return content_->mesh().face_count();
}

template <typename Derived, typename Content>
std::size_t Shape<Derived, Content>::point_count() const {
  return content_->mesh().vertex_count();
}

template <typename Derived, typename Content>
Box3 Shape<Derived, Content>::box() const {
  return content_->box();
}

template <typename Derived, typename Content>
double Shape<Derived, Content>::area() const {
  const NearestRounding rounding;
  return *nearest_area(content_->mesh().points(), triangles_of(content_->mesh()));
}

template <typename Derived, typename Content>
IndexedTriangles Shape<Derived, Content>::triangles() const {
  return detail::rounded_triangles(content_->mesh());
}

template <typename Derived, typename Content>
bool Shape<Derived, Content>::has_fractions() const {
  return content_->mesh().points().exact_count() > 0;
}

template <typename Derived, typename Content>
Result<Derived> Shape<Derived, Content>::translated(const Vec3& by) const {
  return without_exceptions([&]() -> Result<Derived> {
    A3D_TRY(check_finite("translated", by));
    Surroundings surroundings{Monitor{}};
    return ShapeAccess::outer(
        defined("translated", algebra3d::translated(surroundings.context, *content_, detail::vector(by))));
  });
}

template <typename Derived, typename Content>
Result<Derived> Shape<Derived, Content>::rotated(const Vec3& centre, const Vec3& axis, double degrees) const {
  return without_exceptions([&]() -> Result<Derived> {
    A3D_TRY(check_finite("rotated", centre));
    A3D_TRY(check_finite("rotated", axis));
    A3D_TRY(check_finite("rotated", {degrees, 0, 0}));
    Surroundings surroundings{Monitor{}};
    return ShapeAccess::outer(defined(
        "rotated",
        algebra3d::rotated(surroundings.context, *content_, detail::point(centre), detail::vector(axis), degrees)));
  });
}

template <typename Derived, typename Content>
Result<Derived> Shape<Derived, Content>::scaled(const Vec3& centre, const Vec3& factors) const {
  return without_exceptions([&]() -> Result<Derived> {
    A3D_TRY(check_finite("scaled", centre));
    A3D_TRY(check_finite("scaled", factors));
    Surroundings surroundings{Monitor{}};
    return ShapeAccess::outer(defined(
        "scaled", scaled_by_axis(surroundings.context, *content_, detail::point(centre), detail::vector(factors))));
  });
}

template <typename Derived, typename Content>
Result<Derived> Shape<Derived, Content>::mirrored(const Vec3& point, const Vec3& normal) const {
  return without_exceptions([&]() -> Result<Derived> {
    A3D_ASSIGN(const Plane3d plane, detail::plane_through("mirrored", point, normal));
    Surroundings surroundings{Monitor{}};
    return ShapeAccess::outer(defined("mirrored", algebra3d::mirrored(surroundings.context, *content_, plane)));
  });
}

template <typename Derived, typename Content>
std::string Shape<Derived, Content>::bytes() const {
  return encode(ShapeAccess::value(*this));
}

template <typename Derived, typename Content>
std::string Shape<Derived, Content>::text() const {
  return ShapeAccess::value(*this).to_nested().print();
}

template <typename Derived, typename Content>
std::ostream& Shape<Derived, Content>::print(std::ostream& out) const {
  return out << text();
}

template <typename Derived, typename Content>
std::strong_ordering Shape<Derived, Content>::compare(const Derived& other) const {
  const NearestRounding rounding;
  return algebra3d::compare(ShapeAccess::value(*this), ShapeAccess::value(other));
}

template <typename Derived, typename Content>
std::size_t Shape<Derived, Content>::hash() const {
  const NearestRounding rounding;
  return algebra3d::hash(ShapeAccess::value(*this));
}

template class Shape<Solid, Volume3d>;
template class Shape<Surface, Surface3d>;

}  // namespace algebra3d

// NOLINTEND(clang-analyzer-cplusplus.NewDeleteLeaks,clang-analyzer-cplusplus.NewDelete)
