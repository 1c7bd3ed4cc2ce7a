#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "algebra3d/values/types/value.h"
#include "base/context.h"
#include "base/diagnostics.h"
#include "base/interruption_scope.h"

// Calls of operators of the language from C++. An undefined result is an error with the reason. Messages begin with the
// name of the C++ function instead of the operator's.

namespace algebra3d::detail {

/// The context of an operator call and its diagnostics. Lives as long as the call.
struct Surroundings {
  Diagnostics diagnostics;
  Context context;
  InterruptionScope interruption;

  explicit Surroundings(const Monitor& monitor)
      : context{.diagnostics = diagnostics, .cancel = monitor.cancel(), .folder = {}, .report = monitor.report()},
        interruption(monitor.cancel()) {}
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;
  ~Surroundings() = default;

  /// The error invalid_value with the last diagnostic, or with `otherwise`.
  Error reason(std::string_view otherwise) const;
};

/// Calls an operator by name for a C++ function. Errors: its own; invalid_value with the reason if the result is
/// undefined.
Result<Value> call_operator(std::string_view function, std::string_view name, std::vector<Value> arguments,
                            const Monitor& monitor);
/// The first column of the table that an operator returns.
Result<std::vector<Value>> call_for_values(std::string_view name, std::vector<Value> arguments, const Monitor& monitor);

/// Calls an operator; `T` is the class of the result's type.
template <typename T>
Result<T> call(std::string_view function, std::string_view name, std::vector<Value> arguments,
               const Monitor& monitor = {}) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const Value result, call_operator(function, name, std::move(arguments), monitor));
  return result.get<T>();
}

/// Reads a value of the type of `T` from its binary form or its value list. Errors: those of `decode`; invalid_value.
Result<Value> value_of_bytes(const Type& type, std::string_view bytes);
Result<Value> value_of_text(const Type& type, std::string_view text);

Value point_value(const Vec3& point);
Value vector_value(const Vec3& vector);
/// The plane through a point with a normal, for a C++ function. Errors: invalid_value for a normal of length 0 or
/// coordinates that are not finite.
Result<Plane3d> plane_through(std::string_view function, const Vec3& point, const Vec3& normal);

}  // namespace algebra3d::detail
