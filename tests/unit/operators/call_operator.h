#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"

/// Calls operators as a statement does: by name, through the registry.
namespace algebra3d::calls {

inline Value value(Value v) {
  return v;
}
inline Value value(int i) {
  return Value::of<std::int64_t>(i);
}
inline Value value(const char* text) {
  return Value::of<Text>({text});
}
template <typename T>
Value value(T content) {
  return Value::of<T>(std::move(content));
}

struct Answer {
  std::variant<Value, std::vector<Value>> content;
  std::vector<std::string> diagnostics;

  const Value& single() const { return std::get<Value>(content); }
  const std::vector<Value>& elements() const { return std::get<std::vector<Value>>(content); }
  bool is_defined() const { return single().is_defined(); }
  template <typename T>
  const T& get() const {
    return single().get<T>();
  }
  std::string text() const { return single().to_nested().print(); }
};

/// The cells of the first column.
inline std::vector<Value> first_column(RowSource& rows, Context& context) {
  std::vector<Value> cells;
  while (true) {
    auto row = rows.next(context);
    if (!row) throw std::runtime_error(row.error().text());
    if (!*row) return cells;
    cells.push_back(std::move((**row).front()));
  }
}

inline Answer call_values(const std::string& name, const std::vector<Value>& arguments,
                          const std::filesystem::path& folder = {}) {
  static const Registry registry = make_registry();
  std::vector<TypeExpr> types;
  types.reserve(arguments.size());
  for (const Value& argument : arguments) types.emplace_back(argument.type().name());
  const Operator* op = registry.find_operator(name);
  const auto resolved = registry.resolve(*op, types);
  if (!resolved) throw std::runtime_error(resolved.error().text());
  Diagnostics diagnostics;
  Context context{.diagnostics = diagnostics, .cancel = nullptr, .folder = folder};
  std::vector<Value> values = arguments;
  if (resolved->overload->kind() == OperatorKind::table) {
    auto rows = Registry::rows(*resolved, values, context);
    if (!rows) throw std::runtime_error(rows.error().text());
    std::vector<Value> elements = first_column(**rows, context);
    return {std::move(elements), diagnostics.summary()};
  }
  auto outcome = Registry::call(*resolved, values, context);
  if (!outcome) throw std::runtime_error(outcome.error().text());
  return {*std::move(outcome), diagnostics.summary()};
}

template <typename... Arguments>
Answer call(const std::string& name, Arguments... arguments) {
  return call_values(name, {value(std::move(arguments))...});
}

/// A value from its text, proved.
template <typename T>
T literal(const std::string& text) {
  Diagnostics diagnostics;
  Context context{.diagnostics = diagnostics, .cancel = nullptr, .folder = {}};
  auto read = value_from_nested(TypeOf<T>::type(), *NestedList::parse(text), context);
  if (!read || !read->is_defined()) throw std::runtime_error("no valid literal: " + text);
  return read->template get<T>();
}

inline Point3d point(double x, double y, double z) {
  return {ExactPoint(Vec3{x, y, z})};
}
inline Vector3d vector(double x, double y, double z) {
  return {ExactPoint(Vec3{x, y, z})};
}
inline Volume3d cube(const Point3d& p, const Point3d& q) {
  return call("createCube", p, q).get<Volume3d>();
}

}  // namespace algebra3d::calls
