#pragma once

#include <string_view>
#include <utility>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/values/types/spatial.h"
#include "algebra3d/values/types/value.h"
#include "base/context.h"
#include "base/diagnostics.h"
#include "base/interruption_scope.h"

namespace algebra3d::detail {

/// The context of a call and its diagnostics. Lives as long as the call.
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

/// The value of what is undefined for some arguments. Errors: those of `outcome`; invalid_value with the reason, behind
/// the name of the C++ function.
template <typename T>
Result<T> defined(std::string_view function, Result<Maybe<T>> outcome) {
  if (!outcome) return std::move(outcome).error();
  if (!*outcome) return Error{ErrorCode::invalid_value, "{}: {}", function, outcome->reason()};
  return **std::move(outcome);
}

/// Reads a value of the type of `T` from its binary form or its value list. Errors: those of `decode`; invalid_value.
Result<Value> value_of_bytes(const Type& type, std::string_view bytes);
Result<Value> value_of_text(const Type& type, std::string_view text);

inline Point3d point(const Vec3& position) {
  return {ExactPoint(position)};
}
inline Vector3d vector(const Vec3& components) {
  return {ExactPoint(components)};
}
/// The plane through a point with a normal, for a C++ function. Errors: invalid_value for a normal of length 0 or
/// coordinates that are not finite.
Result<Plane3d> plane_through(std::string_view function, const Vec3& point, const Vec3& normal);

}  // namespace algebra3d::detail
