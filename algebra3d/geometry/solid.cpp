#include "algebra3d/geometry/solid.h"

#include <ostream>

#include "algebra3d/base/context.h"
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

Solid wrapped(Volume3d value) {
  return Solid(std::make_shared<const Volume3d>(std::move(value)));
}

Result<Solid> wrapped(Result<Volume3d> value) {
  if (!value) return std::move(value).error();
  return wrapped(*std::move(value));
}

Value value_of(const Solid& solid) {
  return Value::of<Volume3d>(solid.value());
}

std::vector<Volume3d> values_of(std::span<const Solid> solids) {
  std::vector<Volume3d> values;
  values.reserve(solids.size());
  for (const Solid& solid : solids) values.push_back(solid.value());
  return values;
}

}  // namespace

Solid::Solid() : value_(std::make_shared<const Volume3d>()) {}

Result<Solid> Solid::box(const Vec3& corner, const Vec3& opposite) {
  RETURN_IF_ERROR(check_finite("box", corner));
  RETURN_IF_ERROR(check_finite("box", opposite));
  return wrapped(call<Volume3d>("createCube", {point_value(corner), point_value(opposite)}));
}

Result<Solid> Solid::sphere(const Vec3& centre, double radius, int corners) {
  RETURN_IF_ERROR(check_finite("sphere", centre));
  RETURN_IF_ERROR(check_finite("sphere", {radius, 0, 0}));
  return wrapped(call<Volume3d>("createSphere",
                                {point_value(centre), Value::of<double>(radius), Value::of<std::int64_t>(corners)}));
}

Result<Solid> Solid::of_triangles(std::span<const Vec3> points, std::span<const std::array<std::uint32_t, 3>> triangles,
                                  const Monitor& monitor) {
  return wrapped(detail::proved<Volume3d>(points, triangles, monitor));
}

Result<Solid> Solid::of_bytes(std::string_view bytes) {
  ASSIGN_OR_RETURN(const Value value, detail::value_of_bytes(TypeOf<Volume3d>::type(), bytes));
  return wrapped(value.get<Volume3d>());
}

Result<Solid> Solid::of_text(std::string_view text) {
  ASSIGN_OR_RETURN(const Value value, detail::value_of_text(TypeOf<Volume3d>::type(), text));
  return wrapped(value.get<Volume3d>());
}

std::size_t Solid::triangle_count() const {
  return value_->mesh().face_count();
}

std::size_t Solid::point_count() const {
  return value_->mesh().vertex_count();
}

Box3 Solid::box() const {
  return value_->box();
}

double Solid::volume() const {
  return algebra3d::exact_volume(value_->mesh().points(), triangles_of(value_->mesh()))->nearest_double();
}

std::string Solid::exact_volume() const {
  return algebra3d::exact_volume(value_->mesh().points(), triangles_of(value_->mesh()))->text();
}

double Solid::area() const {
  return *nearest_area(value_->mesh().points(), triangles_of(value_->mesh()));
}

Result<Vec3> Solid::centroid() const {
  ASSIGN_OR_RETURN(const Point3d centroid, call<Point3d>("centroid", {value_of(*this)}));
  return centroid.position.approx();
}

IndexedTriangles Solid::triangles() const {
  return detail::rounded_triangles(value_->mesh());
}

bool Solid::has_fractions() const {
  return value_->mesh().points().exact_count() > 0;
}

Result<Solid> Solid::translated(const Vec3& by) const {
  RETURN_IF_ERROR(check_finite("translated", by));
  return wrapped(call<Volume3d>("translate", {value_of(*this), vector_value(by)}));
}

Result<Solid> Solid::rotated(const Vec3& centre, const Vec3& axis, double degrees) const {
  RETURN_IF_ERROR(check_finite("rotated", centre));
  RETURN_IF_ERROR(check_finite("rotated", axis));
  RETURN_IF_ERROR(check_finite("rotated", {degrees, 0, 0}));
  return wrapped(
      call<Volume3d>("rotate", {value_of(*this), point_value(centre), vector_value(axis), Value::of<double>(degrees)}));
}

Result<Solid> Solid::scaled(const Vec3& centre, const Vec3& factors) const {
  RETURN_IF_ERROR(check_finite("scaled", centre));
  RETURN_IF_ERROR(check_finite("scaled", factors));
  return wrapped(call<Volume3d>("scaleDir", {value_of(*this), point_value(centre), vector_value(factors)}));
}

Result<Solid> Solid::mirrored(const Vec3& point, const Vec3& normal) const {
  ASSIGN_OR_RETURN(Plane3d plane, detail::plane_through(point, normal));
  return wrapped(call<Volume3d>("mirror", {value_of(*this), Value::of<Plane3d>(std::move(plane))}));
}

Result<Solid> Solid::rounded(const Monitor& monitor) const {
  return wrapped(call<Volume3d>("roundCoordinates", {value_of(*this)}, monitor));
}

Result<std::vector<Solid>> Solid::components(const Monitor& monitor) const {
  ASSIGN_OR_RETURN(const std::vector<Value> parts, detail::call_for_values("components", {value_of(*this)}, monitor));
  std::vector<Solid> solids;
  solids.reserve(parts.size());
  for (const Value& part : parts) solids.push_back(wrapped(part.get<Volume3d>()));
  return solids;
}

std::string Solid::bytes() const {
  return encode(value_of(*this));
}

std::string Solid::text() const {
  return value_of(*this).to_nested().print();
}

bool operator==(const Solid& a, const Solid& b) {
  return a <=> b == 0;
}

std::strong_ordering operator<=>(const Solid& a, const Solid& b) {
  return compare(value_of(a), value_of(b));
}

std::size_t Solid::hash() const {
  return algebra3d::hash(value_of(*this));
}

Result<Solid> unite(std::span<const Solid> solids, const Monitor& monitor) {
  detail::Surroundings surroundings(monitor);
  return wrapped(united(surroundings.context, values_of(solids)));
}

Result<Solid> unite(const Solid& a, const Solid& b, const Monitor& monitor) {
  return unite(std::array{a, b}, monitor);
}

Result<Solid> intersect(std::span<const Solid> solids, const Monitor& monitor) {
  if (solids.empty()) return Error{ErrorCode::wrong_usage, "intersect: expected at least one solid"};
  detail::Surroundings surroundings(monitor);
  return wrapped(intersected(surroundings.context, values_of(solids)));
}

Result<Solid> intersect(const Solid& a, const Solid& b, const Monitor& monitor) {
  return intersect(std::array{a, b}, monitor);
}

Result<Solid> subtract(const Solid& a, const Solid& b, const Monitor& monitor) {
  detail::Surroundings surroundings(monitor);
  return wrapped(without(surroundings.context, a.value(), b.value()));
}

Result<Solid> symmetric_difference(const Solid& a, const Solid& b, const Monitor& monitor) {
  detail::Surroundings surroundings(monitor);
  return wrapped(in_either(surroundings.context, a.value(), b.value()));
}

Result<SplitSolid> split(const Solid& solid, const Vec3& point, const Vec3& normal, const Monitor& monitor) {
  ASSIGN_OR_RETURN(const Plane3d plane, detail::plane_through(point, normal));
  detail::Surroundings surroundings(monitor);
  ASSIGN_OR_RETURN(SolidParts parts, split(surroundings.context, solid.value(), plane.plane));
  return SplitSolid{wrapped(std::move(parts.in_front)), wrapped(std::move(parts.behind))};
}

std::ostream& operator<<(std::ostream& out, const Solid& solid) {
  return out << solid.text();
}

}  // namespace algebra3d

// NOLINTEND(clang-analyzer-cplusplus.NewDeleteLeaks,clang-analyzer-cplusplus.NewDelete)
