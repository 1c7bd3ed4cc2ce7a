#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/c.h"

namespace algebra3d {

struct Releaser {
  void operator()(a3d_value* value) const { a3d_release(value); }
  void operator()(a3d_session* session) const { a3d_close(session); }
  void operator()(a3d_rows* rows) const { a3d_close_rows(rows); }
  void operator()(a3d_aggregate* aggregate) const { a3d_close_aggregate(aggregate); }
};
template <typename T>
using Owned = std::unique_ptr<T, Releaser>;
using Owner = Owned<a3d_value>;

/// A session whose functions return null after an error.
class CSession {
 public:
  explicit CSession(const a3d_options& options = {0, 1, nullptr}) : session_(a3d_open(&options)) {}

  a3d_session* get() const { return session_.get(); }
  std::string error() const { return a3d_last_error(get())->message; }
  std::string sql_state() const { return a3d_last_error(get())->sql_state; }

  Owner parsed(std::string_view type, std::string_view text) const {
    a3d_value* value = nullptr;
    return owned(a3d_parse(get(), std::string(type).c_str(), text.data(), text.size(), &value), value);
  }
  std::string text(const Owner& value) const {
    a3d_bytes bytes = {};
    if (a3d_print(get(), value.get(), &bytes) != A3D_OK) return error();
    std::string result(bytes.data, bytes.size);
    a3d_free_bytes(&bytes);
    return result;
  }
  const a3d_function* found(const char* name, const std::vector<const char*>& types) const {
    const a3d_function* function = nullptr;
    return a3d_find(get(), name, types.data(), types.size(), &function) == A3D_OK ? function : nullptr;
  }
  Owner call(const char* name, const std::vector<Owner>& arguments) const {
    if (std::ranges::any_of(arguments, [](const Owner& argument) { return argument == nullptr; })) return nullptr;
    std::vector<const char*> types;
    for (const Owner& argument : arguments) types.push_back(a3d_type_of(argument.get()));
    const a3d_function* const function = found(name, types);
    a3d_value* value = nullptr;
    if (function == nullptr) return nullptr;
    const auto given = pointers(arguments);
    return owned(a3d_call(get(), function, given.data(), given.size(), &value), value);
  }
  Owner cube(std::string_view corner, std::string_view opposite) const {
    std::vector<Owner> corners;
    corners.push_back(parsed("point3d", corner));
    corners.push_back(parsed("point3d", opposite));
    return call("create_cube", corners);
  }

  static std::vector<a3d_value*> pointers(const std::vector<Owner>& values) {
    std::vector<a3d_value*> result;
    for (const Owner& value : values) result.push_back(value.get());
    return result;
  }
  /// The value is read after the call that gives the status.
  static Owner owned(a3d_status status, a3d_value* const& value) { return Owner(status == A3D_OK ? value : nullptr); }

 private:
  Owned<a3d_session> session_;
};

}  // namespace algebra3d
