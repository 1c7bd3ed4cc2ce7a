// withAttribute, setAttribute, clearAttribute, removeAttribute, meshAttributes, realAttribute, pointAttribute,
// vectorAttribute, textAttribute.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// The kind of attribute for a type of values, and the conversion.
template <typename T>
struct ValueOf;

template <>
struct ValueOf<double> {
  static constexpr AttributeKind kKind = AttributeKind::real;
  static constexpr const char* kOperator = "realAttribute";  // the one for its values
  static double get(const AttributeValues& values, std::size_t i) { return values.numbers(i)[0]; }
  static void set(AttributeValues& values, std::size_t i, double value) { values.set(i, std::array{value}); }
};
template <>
struct ValueOf<Point2d> {
  static constexpr AttributeKind kKind = AttributeKind::pair;
  static constexpr const char* kOperator = "pointAttribute";  // the one for its values
  static Point2d get(const AttributeValues& values, std::size_t i) {
    return {ExactPoint(Vec3{values.numbers(i)[0], values.numbers(i)[1], 0})};
  }
  static void set(AttributeValues& values, std::size_t i, const Point2d& value) {
    values.set(i, std::array{value.position.approx().x, value.position.approx().y});
  }
};
template <>
struct ValueOf<Vector3d> {
  static constexpr AttributeKind kKind = AttributeKind::vector;
  static constexpr const char* kOperator = "vectorAttribute";  // the one for its values
  static Vector3d get(const AttributeValues& values, std::size_t i) {
    const auto numbers = values.numbers(i);
    return {ExactPoint(Vec3{numbers[0], numbers[1], numbers[2]})};
  }
  static void set(AttributeValues& values, std::size_t i, const Vector3d& value) {
    const Vec3& v = value.components.approx();
    values.set(i, std::array{v.x, v.y, v.z});
  }
};
template <>
struct ValueOf<Text> {
  static constexpr AttributeKind kKind = AttributeKind::text;
  static constexpr const char* kOperator = "textAttribute";  // the one for its values
  static Text get(const AttributeValues& values, std::size_t i) { return {values.text(i)}; }
  static void set(AttributeValues& values, std::size_t i, const Text& value) {
    values.set_text(i, values.add_text(value.content));
  }
};

Result<MeshElement> element_of(const std::string& operator_name, const std::string& name) {
  if (const auto element = mesh_element_named(name)) return *element;
  return Error{ErrorCode::invalid_value,
               R"({}: the elements are "{}"; expected "vertex", "edge", "halfedge" or "face")", operator_name, name};
}

template <typename T>
Result<Mesh3d> with_attribute(const Mesh3d& mesh, const std::string& elements, const std::string& name,
                              const T& value) {
  A3D_ASSIGN(const MeshElement element, element_of("withAttribute", elements));
  const std::size_t count = element_count(mesh.mesh(), element);
  AttributeValues one(ValueOf<T>::kKind, 1);
  ValueOf<T>::set(one, 0, value);
  const AttributeValues values = one.selected(std::vector<std::uint32_t>(count, 0));
  return mesh.with_attributes(mesh.attributes().with(element, name, values));
}

/// Nothing for the number of an element of the mesh, else what is wrong with it.
std::optional<Undefined> number_fault(const Mesh3d& mesh, MeshElement element, std::int64_t id) {
  const std::size_t count = element_count(mesh.mesh(), element);
  if (id >= 0 && static_cast<std::uint64_t>(id) < count) return std::nullopt;
  return Undefined{fmt::format("there is no {} {}; there are {}, numbered from 0", name_of(element), id, count)};
}

template <typename T>
Result<Maybe<Mesh3d>> set_attribute(const Mesh3d& mesh, const std::string& elements, const std::string& name,
                                    std::int64_t id, const T& value) {
  A3D_ASSIGN(const MeshElement element, element_of("setAttribute", elements));
  if (auto fault = number_fault(mesh, element, id)) return Maybe<Mesh3d>(*std::move(fault));
  AttributeValues values(ValueOf<T>::kKind, element_count(mesh.mesh(), element));
  if (const MeshAttribute* const found = mesh.attributes().find(element, name)) {
    if (found->values->kind() != ValueOf<T>::kKind)
      return Maybe<Mesh3d>(Undefined{fmt::format("the values of {} are of the kind {}, not {}", name,
                                                 name_of(found->values->kind()), name_of(ValueOf<T>::kKind))});
    values = *found->values;
  }
  ValueOf<T>::set(values, static_cast<std::size_t>(id), value);
  return Maybe<Mesh3d>(mesh.with_attributes(mesh.attributes().with(element, name, values)));
}

Result<Maybe<Mesh3d>> clear_attribute(const Mesh3d& mesh, const std::string& elements, const std::string& name,
                                      std::int64_t id) {
  A3D_ASSIGN(const MeshElement element, element_of("clearAttribute", elements));
  if (auto fault = number_fault(mesh, element, id)) return Maybe<Mesh3d>(*std::move(fault));
  const MeshAttribute* const found = mesh.attributes().find(element, name);
  if (found == nullptr) return Maybe<Mesh3d>(mesh);
  AttributeValues values = *found->values;
  values.clear(static_cast<std::size_t>(id));
  return Maybe<Mesh3d>(mesh.with_attributes(mesh.attributes().with(element, name, values)));
}

Result<Mesh3d> remove_attribute(const Mesh3d& mesh, const std::string& elements, const std::string& name) {
  A3D_ASSIGN(const MeshElement element, element_of("removeAttribute", elements));
  return mesh.with_attributes(mesh.attributes().without(element, name));
}

using AttributeRows = Rows<std::string, std::string, std::string, std::int64_t>;

AttributeRows attribute_rows(const Mesh3d& mesh) {
  std::vector<AttributeRows::Cells> rows;
  for (const MeshAttribute& attribute : mesh.attributes().all()) {
    std::int64_t defined = 0;
    for (std::size_t i = 0; i < attribute.values->size(); ++i) defined += attribute.values->is_defined(i) ? 1 : 0;
    rows.emplace_back(std::string(name_of(attribute.element)), attribute.name,
                      std::string(name_of(attribute.values->kind())), defined);
  }
  return AttributeRows(std::move(rows));
}

template <typename T>
using ValueRows = Rows<std::int64_t, std::optional<T>>;

template <typename T>
Result<Maybe<ValueRows<T>>> value_rows(const Mesh3d& mesh, const std::string& elements, const std::string& name) {
  A3D_ASSIGN(const MeshElement element, element_of(ValueOf<T>::kOperator, elements));
  const MeshAttribute* const found = mesh.attributes().find(element, name);
  if (found == nullptr || found->values->kind() != ValueOf<T>::kKind)
    return Maybe<ValueRows<T>>(Undefined{fmt::format("the mesh has no attribute {} of the kind {} of each {}", name,
                                                     name_of(ValueOf<T>::kKind), elements)});
  auto next = [values = found->values, i = std::size_t{0}](Context&) mutable {
    using Next = Result<std::optional<typename ValueRows<T>::Cells>>;
    if (i == values->size()) return Next(std::nullopt);
    std::optional<T> value;
    if (values->is_defined(i)) value = ValueOf<T>::get(*values, i);
    return Next(std::tuple(static_cast<std::int64_t>(i++), std::move(value)));
  };
  return Maybe<ValueRows<T>>(ValueRows<T>(std::move(next)));
}

const std::string kOneTriangle = "(mesh3d (((0 0 0) (1 0 0) (0 1 0)) ((0 1 2))))";
const std::string kWithWeights =
    R"((mesh3d (((0 0 0) (1 0 0) (0 1 0)) ((0 1 2)) ((vertex "Weight" real (1.0 undefined 2.5))))))";

constexpr const char* kElements =
    R"(The elements are "vertex", "edge", "halfedge" or "face", numbered from 0; a half-edge keeps what belongs )"
    "to the corner of its face.";

void register_setting(OperatorGroup& group) {
  group.add({
      .name = "withAttribute",
      .syntax = "withAttribute(_, _, _, _)",
      .doc = "The mesh with a named value, the same one for all its elements of a kind.",
      .detail = std::string(kElements) + " Values with this name are replaced. Values are rounded to doubles.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&with_attribute<double>>("mesh", "elements", "name", "value"),
                    overload<&with_attribute<Point2d>>("mesh", "elements", "name", "value"),
                    overload<&with_attribute<Vector3d>>("mesh", "elements", "name", "value"),
                    overload<&with_attribute<Text>>("mesh", "elements", "name", "value")},
      .examples = {{{kOneTriangle, R"("face")", R"("Material")", "'steel'"},
                    R"((((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 1.0 0.0)) ((0 1 2)) ((face "Material" text ('steel')))))"},
                   {{kUndefinedMesh, R"("face")", R"("Material")", "'steel'"}, "undefined"}},
      .errors = {{{kOneTriangle, R"("side")", R"("Material")", "'steel'"},
                  R"(withAttribute: the elements are "side"; expected "vertex", "edge", "halfedge" or "face")"}},
  });
  group.add({
      .name = "setAttribute",
      .syntax = "setAttribute(_, _, _, _, _)",
      .doc = "The mesh with another named value of one element.",
      .detail =
          std::string(kElements) +
          " If there are no values with this name, those of all others are undefined. Values are rounded to doubles. "
          "Undefined if the number is not an element, or if the values with this name are of another kind.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&set_attribute<double>>("mesh", "elements", "name", "id", "value"),
                    overload<&set_attribute<Point2d>>("mesh", "elements", "name", "id", "value"),
                    overload<&set_attribute<Vector3d>>("mesh", "elements", "name", "id", "value"),
                    overload<&set_attribute<Text>>("mesh", "elements", "name", "id", "value")},
      .examples = {{{kOneTriangle, R"("vertex")", R"("Weight")", "1", "2.5"},
                    R"((((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 1.0 0.0)) ((0 1 2)) )"
                    R"(((vertex "Weight" real (undefined 2.5 undefined)))))"},
                   {{kOneTriangle, R"("vertex")", R"("Weight")", "3", "2.5"}, "undefined"},
                   {{kUndefinedMesh, R"("vertex")", R"("Weight")", "1", "2.5"}, "undefined"}},
      .errors = {{{kOneTriangle, R"("side")", R"("Weight")", "1", "2.5"},
                  R"(setAttribute: the elements are "side"; expected "vertex")"}},
  });
  group.add({
      .name = "clearAttribute",
      .syntax = "clearAttribute(_, _, _, _)",
      .doc = "The mesh with the named value of one element undefined.",
      .detail = std::string(kElements) + " The mesh itself if there are no values with this name. Undefined if the "
                                         "number is not an element.",
      .exactness = Exactness::exact,
      .overloads = {overload<&clear_attribute>("mesh", "elements", "name", "id")},
      .examples = {{{kWithWeights, R"("vertex")", R"("Weight")", "2"},
                    R"((((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 1.0 0.0)) ((0 1 2)) )"
                    R"(((vertex "Weight" real (1.0 undefined undefined)))))"},
                   {{kOneTriangle, R"("vertex")", R"("Weight")", "2"},
                    "(((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 1.0 0.0)) ((0 1 2)))"},
                   {{kWithWeights, R"("vertex")", R"("Weight")", "3"}, "undefined"},
                   {{kUndefinedMesh, R"("vertex")", R"("Weight")", "2"}, "undefined"}},
      .errors = {{{kOneTriangle, R"("side")", R"("Weight")", "2"},
                  R"(clearAttribute: the elements are "side"; expected "vertex")"}},
  });
  group.add({
      .name = "removeAttribute",
      .syntax = "removeAttribute(_, _, _)",
      .doc = "The mesh without the values with a name; the mesh itself if there are none.",
      .detail = kElements,
      .exactness = Exactness::exact,
      .overloads = {overload<&remove_attribute>("mesh", "elements", "name")},
      .examples = {{{kWithWeights, R"("vertex")", R"("Weight")"},
                    "(((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 1.0 0.0)) ((0 1 2)))"},
                   {{kUndefinedMesh, R"("vertex")", R"("Weight")"}, "undefined"}},
      .errors = {{{kOneTriangle, R"("side")", R"("Weight")"},
                  R"(removeAttribute: the elements are "side"; expected "vertex")"}},
  });
}

template <typename T>
void register_values(OperatorGroup& group, const std::string& what, const std::string& type,
                     std::vector<Example> examples) {
  const std::string name = ValueOf<T>::kOperator;
  examples.push_back({{kOneTriangle, R"("face")", R"("Weight")"}, "()"});
  examples.push_back({{kUndefinedMesh, R"("face")", R"("Weight")"}, "()"});
  group.add({
      .name = name,
      .syntax = name + "(_, _, _)",
      .doc = fmt::format("The named values of elements that are {}, a row for each element (Id: int, Value: {}).", what,
                         type),
      .detail = std::string(kElements) + " Undefined if there are no values with this name, or of another kind.",
      .exactness = Exactness::exact,
      .overloads = {table<&value_rows<T>>({"Id", "Value"}, "mesh", "elements", "name")},
      .examples = std::move(examples),
      .errors = {{{kOneTriangle, R"("side")", R"("Weight")"},
                  name + R"(: the elements are "side"; expected "vertex")"}},
  });
}

}  // namespace

void register_mesh_attributes(OperatorGroup& group) {
  register_setting(group);
  group.add({
      .name = "meshAttributes",
      .syntax = "meshAttributes(_)",
      .doc = "The named values of the elements of a mesh, a row for each name (Elements: string, Name: string, Kind: "
             "string, "
             "Defined: int).",
      .detail = "Kind is real, pair, vector or text; Defined the number of elements with a value. In the order of "
                "elements (vertex, edge, halfedge, face) and names.",
      .exactness = Exactness::exact,
      .overloads = {table<&attribute_rows>({"Elements", "Name", "Kind", "Defined"}, "mesh")},
      .examples = {{{kWithWeights}, R"((("vertex" "Weight" "real" 2)))"},
                   {{kOneTriangle}, "()"},
                   {{kUndefinedMesh}, "()"}},
      .errors = {{{"1"}, "meshAttributes: expected (mesh3d), got (int)"}},
  });
  register_values<double>(group, "reals", "real",
                          {{{kWithWeights, R"("vertex")", R"("Weight")"}, "((0 1.0) (1 undefined) (2 2.5))"}});
  register_values<Point2d>(
      group, "pairs, such as texture coordinates", "point",
      {{{"(setAttribute " + kOneTriangle + R"( "halfedge" "TextureCoordinate" 0 (makePoint 0.5 1)))", R"("halfedge")",
         R"("TextureCoordinate")"},
        "((0 (0.5 1.0)) (1 undefined) (2 undefined))"}});
  register_values<Vector3d>(
      group, "vectors, such as normals", "vector3d",
      {{{"(withAttribute " + kOneTriangle + R"( "face" "Normal" (makeVector3D 0 0 1)))", R"("face")", R"("Normal")"},
        "((0 (0.0 0.0 1.0)))"}});
  register_values<Text>(
      group, "texts, such as materials", "text",
      {{{"(withAttribute " + kOneTriangle + R"( "face" "Material" 'steel'))", R"("face")", R"("Material")"},
        "((0 'steel'))"}});
}

}  // namespace algebra3d
