#include "algebra3d/geometry/operator_call.h"

#include <utility>
#include <variant>

#include "algebra3d/operators/all.h"
#include "algebra3d/types/codec.h"
#include "algebra3d/types/nested_list.h"

// The analyzer does not follow how many values share an object.
// NOLINTBEGIN(clang-analyzer-cplusplus.NewDeleteLeaks,clang-analyzer-cplusplus.NewDelete)

namespace algebra3d::detail {
namespace {

const Registry& operators() {
  static const Registry registry = make_registry();
  return registry;
}

using Outcome = std::variant<Value, std::vector<Value>>;

Result<Outcome> outcome_of(std::string_view name, const std::vector<Value>& arguments, Context& context) {
  std::vector<TypeExpr> types;
  types.reserve(arguments.size());
  for (const Value& argument : arguments) types.emplace_back(argument.type().name());
  const Operator* op = operators().find_operator(name);
  if (op == nullptr) return Error{ErrorCode::internal, "there is no operator '{}'", name};
  ASSIGN_OR_RETURN(const ResolvedCall call, operators().resolve(*op, types));
  return Registry::call(call, arguments, context);
}

}  // namespace

Error Surroundings::reason(std::string_view otherwise) const {
  std::string text;
  for (const std::string& line : diagnostics.summary()) text += (text.empty() ? "" : "; ") + line;
  return {ErrorCode::invalid_value, text.empty() ? std::string(otherwise) : text};
}

Result<Value> call_operator(std::string_view name, const std::vector<Value>& arguments, const Monitor& monitor) {
  Surroundings surroundings(monitor);
  ASSIGN_OR_RETURN(Outcome outcome, outcome_of(name, arguments, surroundings.context));
  auto& result = std::get<Value>(outcome);
  if (!result.is_defined()) return surroundings.reason("undefined");
  return std::move(result);
}

Result<std::vector<Value>> call_for_values(std::string_view name, const std::vector<Value>& arguments,
                                           const Monitor& monitor) {
  Surroundings surroundings(monitor);
  ASSIGN_OR_RETURN(Outcome outcome, outcome_of(name, arguments, surroundings.context));
  return std::move(std::get<std::vector<Value>>(outcome));
}

Result<Value> value_of_bytes(const Type& type, std::string_view bytes) {
  ASSIGN_OR_RETURN(Value value, decode(type, bytes, Origin::elsewhere));
  if (!value.is_defined()) return Error{ErrorCode::invalid_value, "{}: the value is undefined", type.name()};
  return value;
}

Result<Value> value_of_text(const Type& type, std::string_view text) {
  ASSIGN_OR_RETURN(const NestedList list, NestedList::parse(text));
  Surroundings surroundings(Monitor{});
  ASSIGN_OR_RETURN(Value value, value_from_nested(type, list, surroundings.context));
  if (!value.is_defined()) return surroundings.reason("the value is undefined");
  return value;
}

Value point_value(const Vec3& point) {
  return Value::of<Point3d>({ExactPoint(point)});
}

Value vector_value(const Vec3& vector) {
  return Value::of<Vector3d>({ExactPoint(vector)});
}

Result<Plane3d> plane_through(const Vec3& point, const Vec3& normal) {
  return call<Plane3d>("makePlane3D", {point_value(point), vector_value(normal)});
}

}  // namespace algebra3d::detail

// NOLINTEND(clang-analyzer-cplusplus.NewDeleteLeaks,clang-analyzer-cplusplus.NewDelete)
