#pragma once

#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "algebra3d/values/types/coordinate_text.h"
#include "algebra3d/values/types/value.h"

/// Arguments for every type, at any scale, for tests of operators at both ends of the range of doubles.
namespace algebra3d::ranges {

using Texts = std::map<std::string_view, std::vector<const char*>>;

/// Value lists with small integers as coordinates. Volumes, areas and lengths are doubles, where the shapes allow it.
inline const Texts& shapes() {
  static const char* const cube =
      "(((0 0 0) (0 4 0) (4 4 0)) ((0 0 0) (4 4 0) (4 0 0)) ((0 0 4) (4 0 4) (4 4 4)) ((0 0 4) (4 4 4) (0 4 4)) "
      "((0 0 0) (4 0 0) (4 0 4)) ((0 0 0) (4 0 4) (0 0 4)) ((0 4 0) (0 4 4) (4 4 4)) ((0 4 0) (4 4 4) (4 4 0)) "
      "((0 0 0) (0 0 4) (0 4 4)) ((0 0 0) (0 4 4) (0 4 0)) ((4 0 0) (4 4 0) (4 4 4)) ((4 0 0) (4 4 4) (4 0 4)))";
  static const char* const corner =
      "(((1 1 1) (1 5 1) (4 1 1)) ((1 1 1) (4 1 1) (1 1 7)) ((1 1 1) (1 1 7) (1 5 1)) ((4 1 1) (1 5 1) (1 1 7)))";
  static const char* const growing =
      "(((\"2011-07-08\" \"2011-07-10\" TRUE FALSE) ((((1 1 0 0) (1 1 4 0) (1 1 4 4) (1 1 0 4))))))";
  static const Texts texts = {
      {"point3d", {"(1 2 3)", "(4 0 -2)", "(0 0 0)"}},
      {"vector3d", {"(2 0 0)", "(0 -3 4)", "(1 2 -2)"}},
      {"points3d", {"((1 2 3) (4 0 -2))", "((0 0 0) (1 2 3) (7 7 7))", "()"}},
      {"surface3d",
       {"(((0 0 1) (4 0 1) (0 3 1)))", "(((0 0 0) (4 0 0) (4 4 2)) ((0 0 0) (4 4 2) (0 4 2)))",
        "(((1 -1 0) (1 5 0) (1 2 4)))"}},
      {"volume3d", {cube, corner, "()"}},
      {"mesh3d",
       {"(((0 0 0) (4 0 0) (4 4 0) (0 4 0) (0 0 4) (4 0 4) (4 4 4) (0 4 4)) "
        "((3 2 1 0) (4 5 6 7) (0 1 5 4) (1 2 6 5) (2 3 7 6) (3 0 4 7)))",
        "(((0 0 1) (4 0 0) (4 3 2) (0 3 0)) ((0 1 2 3)))",
        "(((0 0 0) (0 0 4) (4 0 0) (0 4 0) (7 7 7)) ((0 1 2) (0 1 3) (1 0 3)) ((face \"F\" text ('a' undefined "
        "'b'))))"}},
      {"rect3", {"(0.0 4.0 0.0 2.0 0.0 6.0)", "(2.0 5.0 -1.0 3.0 1.0 7.0)", "(5.0 6.0 4.0 4.0 0.0 3.0)"}},
      {"rect", {"(0.0 4.0 0.0 2.0)", "(1.0 6.0 -1.0 3.0)"}},
      {"point", {"(1 2)", "(0 -4)"}},
      {"region",
       {"((((0 0) (4 0) (4 4) (0 4)) ((1 1) (1 3) (3 3) (3 1))))", "((((2 -1) (6 -1) (6 2) (2 2))))",
        "((((0 0) (3 0) (0 4))))"}},
      {"mregion", {growing}},
      {"uregion", {"((\"2011-07-08\" \"2011-07-10\" TRUE FALSE) ((((1 1 0 0) (1 1 4 0) (1 1 4 4) (1 1 0 4)))))"}},
      // The point is scaled, the normal is a direction.
      {"plane3d", {"((1 0 0) (1 0 0))", "((0 2 1) (0 0 1))", "((1 1 2) (1 2 2))"}},
  };
  return texts;
}

/// Value lists that no scale changes; of other types, the example of the type.
inline const Texts& plain_values() {
  static const Texts texts = {
      {"int", {"4", "1", "3"}},
      {"real", {"-2", "0.5", "90"}},
      {"bool", {"TRUE", "FALSE"}},
      {"string", {"\"x\"", "\"yz\""}},
      {"text", {"'no such file'", "'x'"}},
      {"instant", {"\"2011-07-09\"", "\"2012-01-01\""}},
      {"duration", {"(1 0)", "(0 5000)"}},
      {"interval", {"(\"2011-01-01\" \"2012-01-01\" TRUE FALSE)"}},
  };
  return texts;
}

/// Parameters of type real or vector3d that are not lengths, by name: factors, angles, directions. All others of an
/// operator on shapes are lengths.
inline bool is_plain(const Parameter& parameter) {
  // A value is that of an attribute.
  static const std::set<std::string_view> names = {"factor", "factors", "degrees", "axis", "direction", "value"};
  return names.contains(parameter.name);
}

inline std::optional<Value> read(const Type& type, const NestedList& list) {
  Diagnostics diagnostics;
  Context context{.diagnostics = diagnostics, .cancel = nullptr, .folder = {}};
  auto value = value_from_nested(type, list, context);
  if (!value || !value->is_defined()) return std::nullopt;
  return *std::move(value);
}

/// All numbers of the list times the factor.
inline NestedList scaled(const NestedList& list, const Rational& factor) {
  if (list.is_list()) {
    NestedList::List elements;
    for (const NestedList& element : list.elements()) elements.push_back(scaled(element, factor));
    return NestedList(std::move(elements));
  }
  const auto number = coordinate_from_nested(list, "scaled");
  return number ? coordinate_to_nested(*number * factor) : list;
}

/// The list of a mesh3d with other vertices.
inline NestedList with_vertices(const NestedList& mesh, NestedList vertices) {
  NestedList::List parts = mesh.elements();
  parts[0] = std::move(vertices);
  return NestedList(std::move(parts));
}

/// The value list of a value of this type when all lengths are multiplied.
inline NestedList scaled_shape(const Type& type, const NestedList& list, const Rational& factor) {
  if (type.name() == "mesh3d") return with_vertices(list, scaled(list.elements()[0], factor));
  if (type.name() != "plane3d") return scaled(list, factor);
  return NestedList::list(scaled(list.elements()[0], factor), list.elements()[1]);
}

inline bool is_shape(const Type& type) {
  return shapes().contains(type.name());
}

inline NestedList sample(const Type& type, std::size_t choice) {
  const Texts& texts = is_shape(type) ? shapes() : plain_values();
  const auto found = texts.find(type.name());
  if (found == texts.end()) return *NestedList::parse(type.example());
  return *NestedList::parse(found->second[choice % found->second.size()]);
}

/// Argument number `choice` for the parameter at a scale; nothing if it is not a value.
inline std::optional<Value> argument(const Parameter& parameter, std::size_t choice, const Rational& factor,
                                     bool has_lengths) {
  const Type& type = *parameter.type;
  const bool is_length = has_lengths && type.name() == "real" && !is_plain(parameter);
  if (is_length) return read(type, scaled(NestedList(static_cast<double>(1 + choice % 3)), factor));
  const NestedList list = sample(type, choice);
  return read(type, is_shape(type) && !is_plain(parameter) ? scaled_shape(type, list, factor) : list);
}

/// The list with each number i of its text replaced by the i-th of these, which ascend; so boxes stay boxes.
inline NestedList stretched(const NestedList& list, std::size_t shift) {
  constexpr double kTiny = std::numeric_limits<double>::denorm_min(), kHuge = std::numeric_limits<double>::max();
  static const std::vector<double> numbers = {-kHuge, -1e308, -1,    -kTiny, 0,     kTiny, 3 * kTiny,
                                              1e-308, 1,      1e100, 1e300,  1e308, kHuge};
  if (list.is_list()) {
    NestedList::List elements;
    for (const NestedList& element : list.elements()) elements.push_back(stretched(element, shift));
    return NestedList(std::move(elements));
  }
  const auto number = coordinate_from_nested(list, "stretched");
  if (!number) return list;
  const auto place = static_cast<std::size_t>(number->nearest_double() + 3) + shift;
  return NestedList(numbers[place % numbers.size()]);
}

/// The value list of a value of this type with its lengths replaced like that.
inline NestedList stretched_shape(const Type& type, const NestedList& list, std::size_t shift) {
  return type.name() == "mesh3d" ? with_vertices(list, stretched(list.elements()[0], shift)) : stretched(list, shift);
}

}  // namespace algebra3d::ranges
