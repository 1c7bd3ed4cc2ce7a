#pragma once

#include <array>
#include <optional>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/operators/registry/registry.h"
#include "algebra3d/values/types/nested_list.h"
#include "algebra3d/values/types/type_expr.h"

namespace queries {

using algebra3d::NestedList;
using algebra3d::TypeExpr;

/// An exact motion of space that maps every axis to an axis of the same direction: a cyclic permutation of the axes,
/// then a translation. It preserves volumes, areas, lengths, angles and orientations, and maps boxes to boxes. A
/// regular value type.
class Motion {
 public:
  /// The identity.
  Motion() = default;
  /// A translation. `types`, which outlives the motion, gives the meaning of numbers in values (Type::coordinates).
  static Motion translation(const algebra3d::Registry& types, const algebra3d::Vec3& offset);
  /// The permutation that maps x to y, y to z, and z to x.
  static Motion turned_axes(const algebra3d::Registry& types);
  Motion inverse() const;

  /// The value list of the image of a value of `type`, also within tuples and relations. Other than spatial values do
  /// not change. Domain: any list; a list that is not a value of the type is returned unchanged, so that its error
  /// stays the same. Exact (coordinates may become fractions), but the bounds of a rect3 are rounded to nearest.
  NestedList image(const TypeExpr& type, const NestedList& list) const;

  /// Moves the constants of a command, a function or a saved object in nested-list form: `(T L)`, `(const T value L)`
  /// and `(OBJECT name (type) T L ...)`.
  NestedList image_of_constants(const NestedList& form) const;

  /// True for the types whose values a motion changes.
  static bool moves(const algebra3d::Type& type);

 private:
  using Moved = std::optional<NestedList>;  // nothing for malformed lists

  algebra3d::RationalVec3 point(const algebra3d::RationalVec3& p) const;
  algebra3d::RationalVec3 direction(const algebra3d::RationalVec3& v) const;
  Moved moved(algebra3d::Type::Coordinates coordinates, const NestedList& list) const;
  Moved point_list(const NestedList& list) const;
  Moved direction_list(const NestedList& list) const;
  Moved points(const NestedList& list) const;
  Moved mesh(const NestedList& list) const;
  Moved triangles(const NestedList& list) const;
  Moved plane(const NestedList& list) const;
  Moved box(const NestedList& list) const;

  const algebra3d::Registry* types_ = nullptr;     // null: no value is moved
  std::array<std::size_t, 3> source_ = {0, 1, 2};  // axis i of the image is this axis of the original, plus offset
  algebra3d::Vec3 offset_;
};

/// A canonical form of a value list, independent of the frame: points sorted, triangles beginning at their smallest
/// corner and sorted, planes by the point nearest to the origin. Operators order triangles by the axes; this order is
/// not part of the value.
NestedList frame_free(const algebra3d::Registry& types, const TypeExpr& type, const NestedList& list);

/// Applies `change` to the value list of a result list `(T V)`; other results are unchanged.
template <typename Change>
NestedList with_changed_value(const NestedList& result, Change change) {
  if (!result.is_list() || result.elements().size() != 2) return result;
  const auto type = TypeExpr::from_nested(result.elements()[0]);
  if (!type) return result;
  return NestedList::list(result.elements()[0], change(*type, result.elements()[1]));
}

}  // namespace queries
