#pragma once

#include <chrono>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/error.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/geometry/solid.h"
#include "algebra3d/geometry/surface.h"

namespace algebra3d {
class Type;
}

namespace algebra3d::database {

/// The C++ types of instant and duration. The language has no time zones and no leap seconds.
using Instant = std::chrono::sys_time<std::chrono::milliseconds>;
using Duration = std::chrono::milliseconds;

/// Any integer type of at most 64 bits that is neither bool nor a character.
template <typename T>
concept Integer = std::integral<T> && sizeof(T) <= sizeof(std::int64_t) && !std::same_as<T, bool> &&
                  !std::same_as<T, char> && !std::same_as<T, wchar_t> && !std::same_as<T, char8_t> &&
                  !std::same_as<T, char16_t> && !std::same_as<T, char32_t>;

/// The C++ types that a value can be read as.
template <typename T>
concept ReadableType = std::same_as<T, bool> || Integer<T> || std::same_as<T, double> || std::same_as<T, std::string> ||
    std::same_as<T, Vec3> || std::same_as<T, std::vector<Vec3>> || std::same_as<T, Box3> || std::same_as<T, Solid> ||
    std::same_as<T, Surface> || std::same_as<T, Instant> || std::same_as<T, Duration>;

namespace detail {
struct ValueContent;
struct ValueAccess;
}  // namespace detail

/// A value of a type of the query language, defined or undefined. Immutable and cheap to copy: large values are shared.
/// Concurrent use is safe.
///
///     type of the language        C++
///     bool, int, real             bool, any integer, double
///     string, text                std::string
///     point3d, vector3d           Vec3, rounded: coordinates are exact, see `text`
///     points3d                    std::vector<Vec3>, rounded
///     rect3                       Box3
///     volume3d, surface3d         Solid, Surface
///     instant, duration           Instant, Duration
///     all others                  their notation, see `text` and `parse`
class Value {
 public:
  // Conversions from C++ types. A number that the language does not have (an integer beyond 64 bits, NaN, infinity), an
  // instant outside of the years 1 to 9999, and an empty box become undefined. Strings should be UTF-8 without zero
  // bytes: others can be read back, but parameters of statements must not have them.
  // NOLINTBEGIN(google-explicit-constructor)
  template <std::same_as<bool> T>  // nothing else becomes a bool, no pointer in particular
  Value(T content) : Value(of_bool(content)) {}
  template <Integer T>
  Value(T content) : Value(of_integer(std::cmp_less(content, 0), static_cast<std::uint64_t>(content))) {}
  template <typename T>
  requires std::same_as<T, double> || std::same_as<T, float> Value(T content) : Value(of_real(content)) {}
  Value(std::string content);
  Value(std::string_view content) : Value(std::string(content)) {}
  Value(const char* content);  ///< a null pointer becomes undefined
  Value(std::nullptr_t) = delete;
  Value(const Solid& content);
  Value(const Surface& content);
  Value(const Box3& content);
  Value(Instant content);
  Value(Duration content);
  // NOLINTEND(google-explicit-constructor)

  // A moved-from value keeps its content: moving copies, which costs as much as counting.
  Value(const Value&) = default;
  Value& operator=(const Value&) = default;
  Value(Value&& other) noexcept : Value(std::as_const(other)) {}  // NOLINT(performance-move-constructor-init)
  Value& operator=(Value&& other) noexcept { return *this = std::as_const(other); }
  ~Value() = default;

  // Values of a stated type.
  static Value text(std::string content);  ///< a text; a std::string converts to a string
  static Value point(const Vec3& position);
  static Value vector(const Vec3& components);
  /// Undefined for more than 2^32 - 1 positions, too.
  static Value points(std::span<const Vec3> positions);
  /// An undefined value of the type. Errors: unknown_name.
  static Result<Value> undefined(std::string_view type);
  /// Parses a value of any type that an attribute can have from its notation, as in
  /// `parse("plane3d", "(0.0 0.0 0.0 1.0)")`. Undefined, with the reason, if it is well-formed but not a valid value.
  /// Errors: unknown_name, invalid_value; type_error for relations, tuples, functions and indexes, which are not values
  /// outside of a database (write `[const TYPE value NOTATION]` in a statement).
  static Result<Value> parse(std::string_view type, std::string_view notation);

  /// The name of the type in the language: "int", "volume3d".
  std::string_view type() const;
  bool is_defined() const;
  /// The reason of an undefined value; empty if the value is defined or the reason unknown, as for stored undefined
  /// values.
  std::string_view reason() const;

  /// The value as a C++ type of the table above; an int may be read as a double. Errors: type_error for another type;
  /// invalid_value for an int that is not in the range of T; not_evaluable, with the reason, for an undefined value.
  template <ReadableType T>
  Result<T> get() const {
    using Read = std::conditional_t<Integer<T>, std::int64_t, T>;
    ALGEBRA3D_ASSIGN_OR_RETURN(Read content, read<Read>());
    if constexpr (Integer<T>)
      if (!std::in_range<T>(content)) return not_in_range(content, 8 * sizeof(T), std::is_signed_v<T>);
    return static_cast<T>(std::move(content));
  }
  /// The value, or `otherwise` if it is undefined, of another type or not in the range of T.
  template <ReadableType T>
  T get_or(T otherwise) const {
    return get<T>().value_or(std::move(otherwise));
  }
  std::string get_or(const char* otherwise) const;

  /// The notation of the language, which is exact: `2.5`, `"a string"`, `(1 2/3 0)`, `undefined`. Always UTF-8: other
  /// bytes of a string appear as `\xff`. Cost: linear.
  std::string text() const;

  /// Equal means the same type and value; geometry is equal if its points are. Reasons do not count.
  friend bool operator==(const Value& a, const Value& b) { return a <=> b == 0; }
  /// Order by the name of the type, then by value; undefined comes first. Agrees with ==.
  friend std::strong_ordering operator<=>(const Value& a, const Value& b);
  std::size_t hash() const;

 private:
  friend struct detail::ValueAccess;
  using Content = std::variant<std::monostate, bool, std::int64_t, double, std::shared_ptr<const detail::ValueContent>>;

  Value(const Type& type, Content content) : type_(&type), content_(std::move(content)) {}
  template <typename T>
  Result<T> read() const;
  static Error not_in_range(std::int64_t content, std::size_t bits, bool is_signed);
  static Value of_bool(bool content);
  static Value of_real(double content);
  static Value of_integer(bool is_negative, std::uint64_t bits);

  const Type* type_;
  Content content_;  // empty: undefined without a reason
};

template <>
Result<bool> Value::read() const;
template <>
Result<std::int64_t> Value::read() const;
template <>
Result<double> Value::read() const;
template <>
Result<std::string> Value::read() const;
template <>
Result<Vec3> Value::read() const;
template <>
Result<std::vector<Vec3>> Value::read() const;
template <>
Result<Box3> Value::read() const;
template <>
Result<Solid> Value::read() const;
template <>
Result<Surface> Value::read() const;
template <>
Result<Instant> Value::read() const;
template <>
Result<Duration> Value::read() const;

std::ostream& operator<<(std::ostream& out, const Value& value);

}  // namespace algebra3d::database

template <>
struct std::hash<algebra3d::database::Value> {
  std::size_t operator()(const algebra3d::database::Value& value) const { return value.hash(); }
};
