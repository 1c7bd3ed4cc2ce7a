#include "algebra3d/library/detail/operator_call.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/library/detail/triangles.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/rows.h"
#include "algebra3d/values/types/codec.h"
#include "algebra3d/values/types/nested_list.h"

// The analyzer does not follow how many values share an object.
// NOLINTBEGIN(clang-analyzer-cplusplus.NewDeleteLeaks,clang-analyzer-cplusplus.NewDelete)

namespace algebra3d::detail {
namespace {

const Registry& operators() {
  static const Registry registry = make_registry();
  return registry;
}

Result<ResolvedCall> resolved(std::string_view name, const std::vector<Value>& arguments) {
  std::vector<TypeExpr> types;
  types.reserve(arguments.size());
  for (const Value& argument : arguments) types.push_back(argument.type().term());
  const Operator* op = operators().find_operator(name);
  if (op == nullptr) return Error{ErrorCode::internal, "there is no operator '{}'", name};
  return operators().resolve(*op, types);
}

Error named_after(std::string_view function, std::string_view operator_name, Error error) {
  const std::string prefix = std::string(operator_name) + ": ";
  if (error.message.starts_with(prefix)) error.message.replace(0, operator_name.size(), function);
  return error;
}

}  // namespace

Error Surroundings::reason(std::string_view otherwise) const {
  std::string text;
  for (const std::string& line : diagnostics.summary()) text += (text.empty() ? "" : "; ") + line;
  return {ErrorCode::invalid_value, text.empty() ? std::string(otherwise) : text};
}

Result<Value> call_operator(std::string_view function, std::string_view name, std::vector<Value> arguments,
                            const Monitor& monitor) {
  Surroundings surroundings(monitor);
  ALGEBRA3D_ASSIGN_OR_RETURN(const ResolvedCall call, resolved(name, arguments));
  auto result = Registry::call(call, arguments, surroundings.context);
  if (!result) return named_after(function, name, std::move(result).error());
  if (!result->is_defined())
    return named_after(function, name, surroundings.reason(fmt::format("{}: undefined", name)));
  return result;
}

Result<std::vector<Value>> call_for_values(std::string_view name, std::vector<Value> arguments,
                                           const Monitor& monitor) {
  Surroundings surroundings(monitor);
  ALGEBRA3D_ASSIGN_OR_RETURN(const ResolvedCall call, resolved(name, arguments));
  ALGEBRA3D_ASSIGN_OR_RETURN(const RowSourcePtr rows, Registry::rows(call, arguments, surroundings.context));
  std::vector<Value> values;
  while (true) {
    ALGEBRA3D_ASSIGN_OR_RETURN(std::optional<Row> row, rows->next(surroundings.context));
    if (!row) return values;
    values.push_back(std::move(row->front()));
  }
}

Result<Value> value_of_bytes(const Type& type, std::string_view bytes) {
  ALGEBRA3D_ASSIGN_OR_RETURN(Value value, decode(type, bytes, Origin::elsewhere));
  if (!value.is_defined()) return Error{ErrorCode::invalid_value, "{}: the value is undefined", type.name()};
  return value;
}

Result<Value> value_of_text(const Type& type, std::string_view text) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const NestedList list, NestedList::parse(text));
  Surroundings surroundings(Monitor{});
  ALGEBRA3D_ASSIGN_OR_RETURN(Value value, value_from_nested(type, list, surroundings.context));
  if (!value.is_defined()) return surroundings.reason("the value is undefined");
  return value;
}

Value point_value(const Vec3& point) {
  return Value::of<Point3d>({ExactPoint(point)});
}

Value vector_value(const Vec3& vector) {
  return Value::of<Vector3d>({ExactPoint(vector)});
}

Result<Plane3d> plane_through(std::string_view function, const Vec3& point, const Vec3& normal) {
  ALGEBRA3D_RETURN_IF_ERROR(check_finite(fmt::format("{}: point of the plane", function), point));
  ALGEBRA3D_RETURN_IF_ERROR(check_finite(fmt::format("{}: normal of the plane", function), normal));
  return call<Plane3d>(function, "makePlane3D", {point_value(point), vector_value(normal)});
}

}  // namespace algebra3d::detail

// NOLINTEND(clang-analyzer-cplusplus.NewDeleteLeaks,clang-analyzer-cplusplus.NewDelete)
