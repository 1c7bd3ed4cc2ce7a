#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/base/context.h"
#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/types/scalars.h"
#include "algebra3d/types/spatial.h"
#include "algebra3d/types/value.h"

// Operators of the language, called from C++. Undefined results are errors here, with the reason.

namespace algebra3d::detail {

/// The context that an operator runs in, and what it reports. Lives as long as the call.
struct Surroundings {
  Diagnostics diagnostics;
  Context context;

  explicit Surroundings(const Monitor& monitor)
      : context{.diagnostics = diagnostics, .cancel = monitor.cancel(), .folder = {}, .report = monitor.report()} {}
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;
  ~Surroundings() = default;

  /// Error invalid_value with what was reported, or else that text.
  Error reason(std::string_view otherwise) const;
};

/// The result of the operator of that name. Errors: its own; invalid_value with the reasons if it is undefined.
Result<Value> call_operator(std::string_view name, const std::vector<Value>& arguments, const Monitor& monitor);
/// The elements of the stream that the operator gives.
Result<std::vector<Value>> call_for_values(std::string_view name, const std::vector<Value>& arguments,
                                           const Monitor& monitor);

/// `T` is the class of the result's type.
template <typename T>
Result<T> call(std::string_view name, const std::vector<Value>& arguments, const Monitor& monitor = {}) {
  ASSIGN_OR_RETURN(const Value result, call_operator(name, arguments, monitor));
  return result.get<T>();
}

/// Reads a value of the type of `T` from its stored form or its value list. Errors: those of `decode`; invalid_value.
Result<Value> value_of_bytes(const Type& type, std::string_view bytes);
Result<Value> value_of_text(const Type& type, std::string_view text);

Value point_value(const Vec3& point);
Value vector_value(const Vec3& vector);
/// Errors: invalid_value for a normal of length 0 or coordinates that are not finite.
Result<Plane3d> plane_through(const Vec3& point, const Vec3& normal);

}  // namespace algebra3d::detail
