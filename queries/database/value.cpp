#include "algebra3d/database/value.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include "algebra3d/library/shape_access.h"
#include "algebra3d/operators/registry/registry.h"
#include "algebra3d/values/types/all.h"
#include "algebra3d/values/types/nested_relation.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "algebra3d/values/types/time.h"
#include "algebra3d/values/types/utf8.h"
#include "base/context.h"
#include "base/diagnostics.h"
#include "base/nearest_rounding.h"
#include "base/propagate.h"
#include "base/without_exceptions.h"
#include "queries/database/detail/value_content.h"

// The analyzer does not follow how many values share an object.
// NOLINTBEGIN(clang-analyzer-cplusplus.NewDeleteLeaks,clang-analyzer-cplusplus.NewDelete)

namespace algebra3d::database {
namespace {

using detail::ValueAccess;

// The instants of the language are counted from 2000-01-03 on.
constexpr std::chrono::sys_days kFirstDay{std::chrono::year(2000) / std::chrono::January / 3};

template <typename T>
Value outer_of(T content) {
  return ValueAccess::outer(algebra3d::Value::of<T>(std::move(content)));
}

template <typename T>
Value outer_of(const Maybe<T>& content) {
  if (content) return outer_of<T>(*content);
  return ValueAccess::outer(algebra3d::Value(TypeOf<T>::type()), content.reason());
}

template <typename T>
Value undefined_of(std::string reason) {
  return ValueAccess::outer(algebra3d::Value(TypeOf<T>::type()), std::move(reason));
}

template <typename T>
Value of_coordinates(const Vec3& numbers) {
  if (!is_finite(numbers)) return undefined_of<T>("coordinates that are not finite");
  return outer_of<T>({ExactPoint(numbers)});
}

/// Whether a type, in text or as a nested list, is made by a constructor whose values only databases have.
bool belongs_to_databases(std::string_view type) {
  constexpr std::array<std::string_view, 7> kConstructors = {"rel", "tuple", "stream", "map", "fun", "rtree3", "btree"};
  const std::size_t begin = std::min(type.find_first_not_of("( "), type.size());
  const std::string_view constructor = type.substr(begin, type.find_first_of("( )", begin) - begin);
  return std::ranges::find(kConstructors, constructor) != kConstructors.end();
}

/// The type of nested relations that a nested list names; null for every other text.
const Type* nested_relation_named(std::string_view name) {
  const auto list = NestedList::parse(name);
  if (!list || !list->is_list()) return nullptr;
  const auto term = TypeExpr::from_nested(*list);
  return term && term->is_nested_relation() ? value_type(*term) : nullptr;
}

Result<const Type*> type_named(std::string_view name) {
  std::vector<std::string> names;
  for (const Type* type : all_types()) {
    if (type->name() == name) return type;
    names.emplace_back(type->name());
  }
  if (const Type* nested = nested_relation_named(name)) return nested;
  if (belongs_to_databases(name))
    return Error{
        ErrorCode::type_error,
        "expected a type that an attribute can have, got '{}'; write [const TYPE value NOTATION] in a statement", name};
  const std::string nearest = nearest_name(name, names);
  return Error{ErrorCode::unknown_name, "unknown type '{}'{}", name,
               nearest.empty() ? "" : ", did you mean '" + nearest + "'?"};
}

Error not_readable(const Value& value, std::string_view expected) {
  if (!value.is_defined())
    return {ErrorCode::not_evaluable, "the value is undefined{}{}", value.reason().empty() ? "" : ": ", value.reason()};
  return {ErrorCode::type_error, "expected a value of type {}, got {}", expected, value.type()};
}

/// The object of a defined value of the engine's type of T.
template <typename T>
Result<T> content_of(const Value& value) {
  const algebra3d::Value inner = ValueAccess::inner(value);
  if (!inner.is_defined() || &inner.type() != &TypeOf<T>::type()) return not_readable(value, TypeOf<T>::type().name());
  return inner.get<T>();
}

}  // namespace

Value detail::ValueAccess::outer(const algebra3d::Value& value, std::string reason) {
  const Type& type = value.type();
  if (!value.is_defined() && reason.empty()) return {type, std::monostate()};
  if (value.is_defined() && &type == &TypeOf<bool>::type()) return {type, value.get<bool>()};
  if (value.is_defined() && &type == &TypeOf<std::int64_t>::type()) return {type, value.get<std::int64_t>()};
  if (value.is_defined() && &type == &TypeOf<double>::type()) return {type, value.get<double>()};
  return {type, std::make_shared<const ValueContent>(ValueContent{value, std::move(reason)})};
}

algebra3d::Value detail::ValueAccess::inner(const Value& value) {
  if (const auto* flag = std::get_if<bool>(&value.content_)) return algebra3d::Value::of<bool>(*flag);
  if (const auto* integer = std::get_if<std::int64_t>(&value.content_))
    return algebra3d::Value::of<std::int64_t>(*integer);
  if (const auto* real = std::get_if<double>(&value.content_)) return algebra3d::Value::of<double>(*real);
  if (const auto* shared = std::get_if<std::shared_ptr<const ValueContent>>(&value.content_)) return (*shared)->value;
  return algebra3d::Value(*value.type_);
}

Value detail::ValueAccess::missing(std::string reason) {
  return undefined_of<std::string>(std::move(reason));
}

Value Value::of_bool(bool content) {
  return outer_of<bool>(content);
}

Value Value::of_real(double content) {
  return std::isfinite(content) ? outer_of<double>(content) : undefined_of<double>("not a finite number");
}

Value::Value(std::string content) : Value(outer_of<std::string>(std::move(content))) {}
Value::Value(const char* content)
    : Value(content != nullptr ? outer_of<std::string>(content) : undefined_of<std::string>("a null pointer")) {}
Value::Value(const Solid& content) : Value(outer_of<Volume3d>(algebra3d::detail::ShapeAccess::content(content))) {}
Value::Value(const Surface& content) : Value(outer_of<Surface3d>(algebra3d::detail::ShapeAccess::content(content))) {}

Value::Value(const Box3& content)
    : Value(!content.is_empty() && is_finite(content.min) && is_finite(content.max)
                ? outer_of<Box3>(content)
                : undefined_of<Box3>("an empty or unbounded box")) {}

Value::Value(Instant content) : Value(outer_of(algebra3d::Instant::make((content - kFirstDay).count()))) {}
Value::Value(Duration content) : Value(outer_of(algebra3d::Duration::make(content.count()))) {}

Value Value::of_integer(bool is_negative, std::uint64_t bits) {
  const auto integer = static_cast<std::int64_t>(bits);
  if (!is_negative && integer < 0) return undefined_of<std::int64_t>("an integer of more than 64 bits");
  return outer_of<std::int64_t>(integer);
}

Value Value::text(std::string content) {
  return outer_of<Text>({std::move(content)});
}

Value Value::point(const Vec3& position) {
  return of_coordinates<Point3d>(position);
}

Value Value::vector(const Vec3& components) {
  return of_coordinates<Vector3d>(components);
}

Value Value::points(std::span<const Vec3> positions) {
  constexpr std::size_t kMaxPoints = 0xffffffff;
  if (positions.size() > kMaxPoints) return undefined_of<Points3d>(fmt::format("more than {} points", kMaxPoints));
  std::vector<ExactPoint> points;
  points.reserve(positions.size());
  for (const Vec3& position : positions) {
    if (!is_finite(position)) return undefined_of<Points3d>("coordinates that are not finite");
    points.emplace_back(position);
  }
  return outer_of<Points3d>(Points3d(std::move(points)));
}

Result<Value> Value::undefined(std::string_view type) {
  A3D_ASSIGN(const Type* known, type_named(type));
  return ValueAccess::outer(algebra3d::Value(*known));
}

Result<Value> Value::parse(std::string_view type, std::string_view notation) {
  return without_exceptions([&]() -> Result<Value> {
    A3D_ASSIGN(const Type* known, type_named(type));
    A3D_ASSIGN(const NestedList list, NestedList::parse(notation));
    Diagnostics diagnostics;
    Context context{diagnostics, nullptr, {}};
    A3D_ASSIGN(const algebra3d::Value value, value_from_nested(*known, list, context));
    return ValueAccess::outer(value, value.is_defined() ? "" : diagnostics.last_reason());
  });
}

std::string_view Value::type() const {
  return type_->name();
}

bool Value::is_defined() const {
  if (const auto* shared = std::get_if<std::shared_ptr<const detail::ValueContent>>(&content_))
    return (*shared)->value.is_defined();
  return !std::holds_alternative<std::monostate>(content_);
}

std::string_view Value::reason() const {
  const auto* shared = std::get_if<std::shared_ptr<const detail::ValueContent>>(&content_);
  return shared != nullptr ? std::string_view((*shared)->reason) : std::string_view();
}

Error Value::not_in_range(std::int64_t content, std::size_t bits, bool is_signed) {
  return {ErrorCode::invalid_value, "the int {} is not in the range of {} integers of {} bits", content,
          is_signed ? "signed" : "unsigned", bits};
}

template <>
Result<bool> Value::read() const {
  return content_of<bool>(*this);
}

template <>
Result<std::int64_t> Value::read() const {
  return content_of<std::int64_t>(*this);
}

template <>
Result<double> Value::read() const {
  const NearestRounding rounding;
  if (const auto* integer = std::get_if<std::int64_t>(&content_)) return static_cast<double>(*integer);
  return content_of<double>(*this);
}

template <>
Result<std::string> Value::read() const {
  const algebra3d::Value inner = ValueAccess::inner(*this);
  if (!inner.is_defined() || type_->storage() != Type::Storage::text) return not_readable(*this, "string or text");
  return characters_of(inner);
}

template <>
Result<Vec3> Value::read() const {
  if (type_ == &TypeOf<Vector3d>::type()) {
    A3D_ASSIGN(const Vector3d vector, content_of<Vector3d>(*this));
    return vector.components.approx();
  }
  const auto point = content_of<Point3d>(*this);
  if (!point) return not_readable(*this, "point3d or vector3d");
  return point->position.approx();
}

template <>
Result<std::vector<Vec3>> Value::read() const {
  A3D_ASSIGN(const Points3d points, content_of<Points3d>(*this));
  std::vector<Vec3> positions;
  positions.reserve(points.points().size());
  for (const ExactPoint& point : points.points()) positions.push_back(point.approx());
  return positions;
}

template <>
Result<Box3> Value::read() const {
  return content_of<Box3>(*this);
}

template <>
Result<Solid> Value::read() const {
  A3D_ASSIGN(Volume3d volume, content_of<Volume3d>(*this));
  return algebra3d::detail::ShapeAccess::outer(std::move(volume));
}

template <>
Result<Surface> Value::read() const {
  A3D_ASSIGN(Surface3d surface, content_of<Surface3d>(*this));
  return algebra3d::detail::ShapeAccess::outer(std::move(surface));
}

template <>
Result<Instant> Value::read() const {
  A3D_ASSIGN(const algebra3d::Instant instant, content_of<algebra3d::Instant>(*this));
  return kFirstDay + Duration(instant.milliseconds);
}

template <>
Result<Duration> Value::read() const {
  A3D_ASSIGN(const algebra3d::Duration duration, content_of<algebra3d::Duration>(*this));
  return Duration(duration.milliseconds);
}

std::string Value::get_or(const char* otherwise) const {
  return get_or(std::string(otherwise));
}

std::string Value::text() const {
  return shown_as_text(ValueAccess::inner(*this).to_nested().print());
}

std::strong_ordering operator<=>(const Value& a, const Value& b) {
  const NearestRounding rounding;
  if (a.type_ != b.type_) return a.type_->name() <=> b.type_->name();
  return compare(ValueAccess::inner(a), ValueAccess::inner(b));
}

std::size_t Value::hash() const {
  const NearestRounding rounding;
  return algebra3d::hash(ValueAccess::inner(*this));
}

std::ostream& operator<<(std::ostream& out, const Value& value) {
  return out << value.text();
}

}  // namespace algebra3d::database

// NOLINTEND(clang-analyzer-cplusplus.NewDeleteLeaks,clang-analyzer-cplusplus.NewDelete)
