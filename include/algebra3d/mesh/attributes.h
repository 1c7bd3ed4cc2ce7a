#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "algebra3d/base/vec3.h"
#include "algebra3d/halfedge/handle.h"
#include "algebra3d/halfedge/mesh_element.h"

/// Attributes of the elements of a mesh: named columns with one value for each element, which may be undefined. Reading
/// and writing files, edits, subdivision and simplification keep them. algebra3d/halfedge/mesh_element.h has the names
/// that files use.
namespace algebra3d::mesh {

using algebra3d::AttributeKind;
using algebra3d::MeshElement;
/// Two numbers, such as texture coordinates.
using Vec2 = std::array<double, 2>;

struct AttributeDescription {
  MeshElement element;
  std::string name;
  AttributeKind kind;  ///< real: double, pair: Vec2, vector: Vec3, text: std::string
};

namespace detail {

template <typename Id>
constexpr MeshElement element_of() {
  if constexpr (std::same_as<Id, VertexId>) {
    return MeshElement::vertex;
  } else if constexpr (std::same_as<Id, EdgeId>) {
    return MeshElement::edge;
  } else if constexpr (std::same_as<Id, HalfedgeId>) {
    return MeshElement::halfedge;
  } else {
    static_assert(std::same_as<Id, FaceId>, "expected VertexId, EdgeId, HalfedgeId or FaceId");
    return MeshElement::face;
  }
}

template <typename T>
constexpr AttributeKind kind_of() {
  if constexpr (std::same_as<T, double>) {
    return AttributeKind::real;
  } else if constexpr (std::same_as<T, Vec2>) {
    return AttributeKind::pair;
  } else if constexpr (std::same_as<T, Vec3>) {
    return AttributeKind::vector;
  } else {
    static_assert(std::same_as<T, std::string>, "expected double, Vec2, Vec3 or std::string");
    return AttributeKind::text;
  }
}

/// The arrays of a column, and the owner that keeps them alive.
struct ColumnContent {
  std::shared_ptr<const void> owner;
  std::size_t size = 0;
  std::span<const double> numbers = {};              ///< of all values, NaN where undefined
  std::span<const std::string> texts = {};           ///< each once
  std::span<const std::uint32_t> text_numbers = {};  ///< per element a text, or 2^32 - 1 where undefined
};
using ColumnValues =
    std::variant<std::span<const double>, std::span<const Vec2>, std::span<const Vec3>, std::span<const std::string>>;

}  // namespace detail

/// The values of an attribute, by the handles of their elements. Cheap to copy; independent of the mesh.
template <typename Id, typename T>
class Column {
  static_assert(std::same_as<T, double> || std::same_as<T, Vec2> || std::same_as<T, Vec3>);

 public:
  explicit Column(detail::ColumnContent content) : content_(std::move(content)) {}

  std::size_t size() const { return content_.size; }
  bool is_defined(Id id) const { return !std::isnan(content_.numbers[kWidth * id.index()]); }
  /// NaN if the value is undefined.
  T operator[](Id id) const {
    const double* const first = content_.numbers.data() + kWidth * id.index();
    if constexpr (kWidth == 1)
      return *first;
    else if constexpr (kWidth == 2)
      return {first[0], first[1]};
    else
      return {first[0], first[1], first[2]};
  }
  /// The numbers of all values in the order of the elements, as many for each as `T` has: no copy.
  std::span<const double> numbers() const { return content_.numbers; }

 private:
  static constexpr std::size_t kWidth = sizeof(T) / sizeof(double);

  detail::ColumnContent content_;
};

/// Texts by elements; each different text is stored once.
template <typename Id>
class Column<Id, std::string> {
 public:
  explicit Column(detail::ColumnContent content) : content_(std::move(content)) {}

  std::size_t size() const { return content_.size; }
  bool is_defined(Id id) const { return content_.text_numbers[id.index()] < content_.texts.size(); }
  /// Empty if the value is undefined.
  std::string_view operator[](Id id) const {
    return is_defined(id) ? std::string_view(content_.texts[content_.text_numbers[id.index()]]) : std::string_view();
  }

 private:
  detail::ColumnContent content_;
};

}  // namespace algebra3d::mesh
