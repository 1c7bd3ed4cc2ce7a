#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "algebra3d/base/error.h"
#include "queries/server/detail/http.h"

namespace queries {

/// An error response: its status and the object `error` of docs/http-api.md.
struct Refusal {
  int status = 400;
  std::string code = "bad_request";  ///< an error code of the language, or of the HTTP API
  std::string message = {};
  std::string remedy = {};
  algebra3d::SourcePlace place = {};

  /// `{"code", "message", ...}`
  std::string json() const;
  HttpAnswer answer() const;

  static Refusal bad_request(std::string message) { return {400, "bad_request", std::move(message)}; }
  static Refusal not_found(std::string message) { return {404, "not_found", std::move(message)}; }
};

/// The refusal for an error of a statement or of the database.
Refusal refusal_of(const algebra3d::Error& error);

/// The refusal for an error of SessionPool::run: that there are too many statements is not an error of the statement.
Refusal refusal_of_session(const algebra3d::Error& error);

/// A value, or the refusal of the request that asked for it.
template <typename T>
class [[nodiscard]] Reply {
 public:
  // NOLINTBEGIN(google-explicit-constructor)
  Reply(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Reply(Refusal refusal) : content_(std::in_place_index<1>, std::move(refusal)) {}
  // NOLINTEND(google-explicit-constructor)

  explicit operator bool() const { return content_.index() == 0; }
  T& operator*() & { return std::get<0>(content_); }
  T&& operator*() && { return std::get<0>(std::move(content_)); }
  T* operator->() { return &std::get<0>(content_); }
  const Refusal& refusal() const { return std::get<1>(content_); }

 private:
  std::variant<T, Refusal> content_;
};

}  // namespace queries
