#include "algebra3d/geometry/surface.h"

#include <ostream>

#include "algebra3d/arrangement/surface_arrangement.h"
#include "algebra3d/exact/exact_sum.h"
#include "algebra3d/geometry/operator_call.h"
#include "algebra3d/geometry/triangles.h"
#include "algebra3d/halfedge/mesh_triangles.h"
#include "algebra3d/operators/solid_sets.h"
#include "algebra3d/types/codec.h"

// The analyzer does not follow how many values share an object.
// NOLINTBEGIN(clang-analyzer-cplusplus.NewDeleteLeaks,clang-analyzer-cplusplus.NewDelete)

namespace algebra3d {
namespace {

using detail::call;
using detail::check_finite;
using detail::point_value;
using detail::vector_value;

Surface wrapped(Surface3d value) {
  return Surface(std::make_shared<const Surface3d>(std::move(value)));
}

Result<Surface> wrapped(Result<Surface3d> value) {
  if (!value) return std::move(value).error();
  return wrapped(*std::move(value));
}

Value value_of(const Surface& surface) {
  return Value::of<Surface3d>(surface.value());
}

Result<Surface> combined_by(SurfaceRule rule, const Surface& a, const Surface& b, const Monitor& monitor) {
  detail::Surroundings surroundings(monitor);
  return wrapped(combined(surroundings.context, a.value(), b.value(), rule));
}

}  // namespace

Surface::Surface() : value_(std::make_shared<const Surface3d>()) {}

Result<Surface> Surface::of_triangles(std::span<const Vec3> points,
                                      std::span<const std::array<std::uint32_t, 3>> triangles, const Monitor& monitor) {
  return wrapped(detail::proved<Surface3d>(points, triangles, monitor));
}

Result<Surface> Surface::of_bytes(std::string_view bytes) {
  ASSIGN_OR_RETURN(const Value value, detail::value_of_bytes(TypeOf<Surface3d>::type(), bytes));
  return wrapped(value.get<Surface3d>());
}

Result<Surface> Surface::of_text(std::string_view text) {
  ASSIGN_OR_RETURN(const Value value, detail::value_of_text(TypeOf<Surface3d>::type(), text));
  return wrapped(value.get<Surface3d>());
}

std::size_t Surface::triangle_count() const {
  return value_->mesh().face_count();
}

Box3 Surface::box() const {
  return value_->box();
}

double Surface::area() const {
  return *nearest_area(value_->mesh().points(), triangles_of(value_->mesh()));
}

IndexedTriangles Surface::triangles() const {
  return detail::rounded_triangles(value_->mesh());
}

bool Surface::has_fractions() const {
  return value_->mesh().points().exact_count() > 0;
}

Result<Surface> Surface::translated(const Vec3& by) const {
  RETURN_IF_ERROR(check_finite("translated", by));
  return wrapped(call<Surface3d>("translate", {value_of(*this), vector_value(by)}));
}

Result<Surface> Surface::rotated(const Vec3& centre, const Vec3& axis, double degrees) const {
  RETURN_IF_ERROR(check_finite("rotated", centre));
  RETURN_IF_ERROR(check_finite("rotated", axis));
  RETURN_IF_ERROR(check_finite("rotated", {degrees, 0, 0}));
  return wrapped(call<Surface3d>(
      "rotate", {value_of(*this), point_value(centre), vector_value(axis), Value::of<double>(degrees)}));
}

Result<Surface> Surface::scaled(const Vec3& centre, const Vec3& factors) const {
  RETURN_IF_ERROR(check_finite("scaled", centre));
  RETURN_IF_ERROR(check_finite("scaled", factors));
  return wrapped(call<Surface3d>("scaleDir", {value_of(*this), point_value(centre), vector_value(factors)}));
}

Result<Surface> Surface::mirrored(const Vec3& point, const Vec3& normal) const {
  ASSIGN_OR_RETURN(Plane3d plane, detail::plane_through(point, normal));
  return wrapped(call<Surface3d>("mirror", {value_of(*this), Value::of<Plane3d>(std::move(plane))}));
}

std::string Surface::bytes() const {
  return encode(value_of(*this));
}

std::string Surface::text() const {
  return value_of(*this).to_nested().print();
}

bool operator==(const Surface& a, const Surface& b) {
  return a <=> b == 0;
}

std::strong_ordering operator<=>(const Surface& a, const Surface& b) {
  return compare(value_of(a), value_of(b));
}

std::size_t Surface::hash() const {
  return algebra3d::hash(value_of(*this));
}

Surface boundary(const Solid& solid) {
  return wrapped(Surface3d::trusted(solid.value().mesh()));
}

Result<Surface> section(const Solid& solid, const Vec3& point, const Vec3& normal, const Monitor& monitor) {
  ASSIGN_OR_RETURN(const Plane3d plane, detail::plane_through(point, normal));
  detail::Surroundings surroundings(monitor);
  return wrapped(section(surroundings.context, solid.value(), plane.plane));
}

Result<Surface> unite(const Surface& a, const Surface& b, const Monitor& monitor) {
  return combined_by(SurfaceRule::either, a, b, monitor);
}

Result<Surface> intersect(const Surface& a, const Surface& b, const Monitor& monitor) {
  return combined_by(SurfaceRule::both, a, b, monitor);
}

Result<Surface> subtract(const Surface& a, const Surface& b, const Monitor& monitor) {
  return combined_by(SurfaceRule::first_only, a, b, monitor);
}

std::ostream& operator<<(std::ostream& out, const Surface& surface) {
  return out << surface.text();
}

}  // namespace algebra3d

// NOLINTEND(clang-analyzer-cplusplus.NewDeleteLeaks,clang-analyzer-cplusplus.NewDelete)
