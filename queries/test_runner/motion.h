#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "algebra3d/base/vec3.h"
#include "algebra3d/exact/point.h"
#include "algebra3d/types/nested_list.h"
#include "algebra3d/types/type_expr.h"

namespace queries {

using algebra3d::NestedList;
using algebra3d::TypeExpr;

/// An exact motion of space that maps every axis to an axis of the same direction: a cyclic permutation of the axes,
/// then a translation. Volumes, areas, lengths, angles and orientations stay; boxes stay boxes. A regular value type.
class Motion {
 public:
  /// Every coordinate stays.
  Motion() = default;
  static Motion translation(const algebra3d::Vec3& offset);
  /// What was x becomes y, y becomes z, and z becomes x.
  static Motion turned_axes();
  Motion inverse() const;

  /// The value list of the image of a value of `type`, also within tuples and relations. Values that are not spatial
  /// stay. Domain: any list; one that is no value of the type comes back as it is, so that its error stays the same.
  /// Exactness: exact (coordinates that are no doubles become fractions), but for the bounds of a rect3, which are
  /// doubles and are rounded to nearest.
  NestedList image(const TypeExpr& type, const NestedList& list) const;

  /// A command, a function or a saved object in its nested-list form, with its constants moved: `(T L)`,
  /// `(const T value L)` and `(OBJECT name (type) T L ...)`.
  NestedList image_of_constants(const NestedList& form) const;

  /// True for the types whose values the motion changes.
  static bool moves(std::string_view type);

 private:
  using Moved = std::optional<NestedList>;  // nothing: malformed

  algebra3d::RationalVec3 point(const algebra3d::RationalVec3& p) const;
  algebra3d::RationalVec3 direction(const algebra3d::RationalVec3& v) const;
  Moved spatial(const TypeExpr& type, const NestedList& list) const;
  Moved point_list(const NestedList& list) const;
  Moved direction_list(const NestedList& list) const;
  Moved points(const NestedList& list) const;
  Moved triangles(const NestedList& list) const;
  Moved mesh(const NestedList& list) const;
  Moved plane(const NestedList& list) const;
  Moved box(const NestedList& list) const;

  std::array<std::size_t, 3> source_ = {0, 1, 2};  // axis i of the image is this axis of the original, plus offset
  algebra3d::Vec3 offset_;
};

/// The value list in a form that does not depend on the frame: points sorted, triangles beginning at their smallest
/// corner and sorted, planes by the point nearest to the origin. The order of the triangles that an operator chooses
/// follows the axes, and is no part of a value (language.md 4.5).
NestedList frame_free(const TypeExpr& type, const NestedList& list);

/// The result list `(T V)`, with `change` applied to its value list; other results as they are.
template <typename Change>
NestedList with_changed_value(const NestedList& result, Change change) {
  if (!result.is_list() || result.elements().size() != 2) return result;
  const auto type = TypeExpr::from_nested(result.elements()[0]);
  if (!type) return result;
  return NestedList::list(result.elements()[0], change(*type, result.elements()[1]));
}

}  // namespace queries
