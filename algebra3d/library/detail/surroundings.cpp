#include "algebra3d/library/detail/surroundings.h"

#include <utility>

#include <fmt/format.h>

#include "algebra3d/library/detail/triangles.h"
#include "algebra3d/values/constructions/planes.h"
#include "algebra3d/values/types/codec.h"
#include "algebra3d/values/types/nested_list.h"
#include "base/propagate.h"

// The analyzer does not follow how many values share an object.
// NOLINTBEGIN(clang-analyzer-cplusplus.NewDeleteLeaks,clang-analyzer-cplusplus.NewDelete)

namespace algebra3d::detail {
Error Surroundings::reason(std::string_view otherwise) const {
  std::string text;
  for (const std::string& line : diagnostics.summary()) text += (text.empty() ? "" : "; ") + line;
  return {ErrorCode::invalid_value, text.empty() ? std::string(otherwise) : text};
}

Result<Value> value_of_bytes(const Type& type, std::string_view bytes) {
  A3D_ASSIGN(Value value, decode(type, bytes, Origin::elsewhere));
  if (!value.is_defined()) return Error{ErrorCode::invalid_value, "{}: the value is undefined", type.name()};
  return value;
}

Result<Value> value_of_text(const Type& type, std::string_view text) {
  A3D_ASSIGN(const NestedList list, NestedList::parse(text));
  Surroundings surroundings(Monitor{});
  A3D_ASSIGN(Value value, value_from_nested(type, list, surroundings.context));
  if (!value.is_defined()) return surroundings.reason("the value is undefined");
  return value;
}

Result<Plane3d> plane_through(std::string_view function, const Vec3& point, const Vec3& normal) {
  A3D_TRY(check_finite(fmt::format("{}: point of the plane", function), point));
  A3D_TRY(check_finite(fmt::format("{}: normal of the plane", function), normal));
  return defined<Plane3d>(function, algebra3d::plane_through(detail::point(point), vector(normal)));
}

}  // namespace algebra3d::detail

// NOLINTEND(clang-analyzer-cplusplus.NewDeleteLeaks,clang-analyzer-cplusplus.NewDelete)
