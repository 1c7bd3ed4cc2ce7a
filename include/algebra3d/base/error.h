#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/core.h>

namespace algebra3d {

/// The kinds of errors. Each code has a row in the table of `describe`; the message of an error has the details.
enum class ErrorCode {
  syntax_error,
  unknown_name,
  type_error,
  reserved_name,
  name_exists,
  not_evaluable,
  invalid_value,
  no_database,
  database_exists,
  database_missing,
  database_open,
  database_corrupt,
  database_foreign,
  database_version,
  database_busy,
  database_read_only,
  disk_full,
  file_missing,
  file_format,
  io_error,
  permission_denied,
  limit_exceeded,
  out_of_memory,
  interrupted,
  wrong_usage,
  internal,
};

/// One row of the table of error codes.
struct ErrorDescription {
  ErrorCode code;
  std::string_view name;       ///< the enumerator's spelling, as shown to people
  std::string_view sql_state;  ///< five characters, for PostgreSQL
  std::string_view meaning;    ///< one sentence
  std::string_view remedy;     ///< what the user can do, one sentence
};

/// The row of `code`. Cost: constant.
const ErrorDescription& describe(ErrorCode code);

/// A position in query text: line and column count from 1, 0 means unknown; `file` is empty for typed text.
struct SourcePlace {
  std::string file;
  int line = 0;
  int column = 0;

  bool is_known() const { return line > 0; }
};

/// The command is wrong or a resource failed. The message says what was found, where, and what was expected. Who passes
/// an error on and knows more of it sets the subject; the parts are joined where the error is shown (`text`).
struct Error {
  ErrorCode code = ErrorCode::internal;
  std::string message;
  std::string subject;  ///< what the message is about (file, operator, function), if it does not say so itself
  SourcePlace place;

  Error(ErrorCode error_code, std::string text) : code(error_code), message(std::move(text)) {}

  template <typename... Args>
  Error(ErrorCode error_code, fmt::format_string<Args...> format, Args&&... args) requires(sizeof...(Args) > 0)
      : code(error_code), message(fmt::format(format, std::forward<Args>(args)...)) {}

  /// The error with the position `where`, unless it has one already.
  Error at(SourcePlace where) &&;
  /// The error with the subject `what`; a subject that it has already stands behind it.
  Error about(std::string_view what) &&;
  /// For people: the subject, a colon and the message; without a subject the message.
  std::string text() const;
};

/// Either a value or an error.
template <typename T>
class [[nodiscard]] Result {
 public:
  using value_type = T;

  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  T& value() & { return assert(ok()), std::get<0>(content_); }
  const T& value() const& { return assert(ok()), std::get<0>(content_); }
  T&& value() && { return assert(ok()), std::move(std::get<0>(content_)); }

  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  /// The value, or `otherwise` if there is an error.
  T value_or(T otherwise) const& { return ok() ? std::get<0>(content_) : std::move(otherwise); }
  T value_or(T otherwise) && { return ok() ? std::move(std::get<0>(content_)) : std::move(otherwise); }

  Error& error() & { return assert(!ok()), std::get<1>(content_); }
  const Error& error() const& { return assert(!ok()), std::get<1>(content_); }
  Error&& error() && { return assert(!ok()), std::move(std::get<1>(content_)); }

 private:
  std::variant<T, Error> content_;
};

/// Success or an error.
template <>
class [[nodiscard]] Result<void> {
 public:
  using value_type = void;

  Result() = default;
  Result(Error error) : error_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  bool ok() const { return !error_; }
  explicit operator bool() const { return ok(); }
  Error& error() & { return assert(!ok()), *error_; }
  const Error& error() const& { return assert(!ok()), *error_; }
  Error&& error() && { return assert(!ok()), std::move(*error_); }

 private:
  std::optional<Error> error_;
};

using Status = Result<void>;

/// The language's *undefined*, with the reason that travels to the user as a diagnostic.
struct Undefined {
  std::string reason;
};

/// A defined value, or *undefined* with its reason: the result of an operator that is not defined for all arguments.
template <typename T>
class [[nodiscard]] Maybe {
 public:
  using value_type = T;

  Maybe(T value) : content_(std::in_place_index<0>, std::move(value)) {}  // NOLINT(google-explicit-constructor)
  Maybe(Undefined undefined)                                              // NOLINT(google-explicit-constructor)
      : content_(std::in_place_index<1>, std::move(undefined)) {}

  bool is_defined() const { return content_.index() == 0; }
  explicit operator bool() const { return is_defined(); }

  T& value() & { return assert(is_defined()), std::get<0>(content_); }
  const T& value() const& { return assert(is_defined()), std::get<0>(content_); }
  T&& value() && { return assert(is_defined()), std::move(std::get<0>(content_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  const std::string& reason() const { return assert(!is_defined()), std::get<1>(content_).reason; }

 private:
  std::variant<T, Undefined> content_;
};

}  // namespace algebra3d

// Macros for the propagation of errors. NOLINTBEGIN(cppcoreguidelines-macro-usage)
#define ALGEBRA3D_CONCAT_(a, b) a##b
#define ALGEBRA3D_CONCAT(a, b) ALGEBRA3D_CONCAT_(a, b)

/// Returns the error of `expression`, if it has one, from the function.
#define ALGEBRA3D_RETURN_IF_ERROR(expression)                                     \
  do {                                                                            \
    if (auto status_ = (expression); !status_) return std::move(status_).error(); \
  } while (false)

/// Assigns the value of `expression` (a Result) to `target`, or returns its error from the function.
#define ALGEBRA3D_ASSIGN_OR_RETURN(target, expression) \
  ALGEBRA3D_ASSIGN_OR_RETURN_(target, expression, ALGEBRA3D_CONCAT(result_at_line_, __LINE__))
#define ALGEBRA3D_ASSIGN_OR_RETURN_(target, expression, result) \
  auto result = (expression);                                   \
  if (!result) return std::move(result).error();                \
  target = std::move(result).value()
// NOLINTEND(cppcoreguidelines-macro-usage)
