#include "queries/test_runner/detail/motion.h"

#include <algorithm>

#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/values/types/coordinate_text.h"

namespace queries {
namespace {

using algebra3d::ExactPlane;
using algebra3d::RationalVec3;
using algebra3d::Registry;
using algebra3d::Vec3;
using Coordinates = algebra3d::Type::Coordinates;

/// The kind of the numbers of a value of the type; `none` if there is no such type.
Coordinates coordinates_of(const Registry& types, const TypeExpr& type) {
  const algebra3d::Type* const found = type.arguments().empty() ? types.find_type(type.name()) : nullptr;
  return found == nullptr ? Coordinates::none : found->coordinates();
}

std::optional<RationalVec3> triple(const NestedList& list) {
  auto result = algebra3d::triple_from_nested(list, "");
  return result ? std::optional(std::move(result).value()) : std::nullopt;
}

template <std::size_t count>
std::optional<std::array<double, count>> doubles(const NestedList& list) {
  if (!list.is_list() || list.elements().size() != count) return std::nullopt;
  std::array<double, count> numbers{};
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = algebra3d::double_from_nested(list.elements()[i], "");
    if (!number) return std::nullopt;
    numbers[i] = *number;
  }
  return numbers;
}

struct PointAndNormal {
  RationalVec3 point, normal;
};

// The point is the one nearest to the origin, which a plane has but one of.
std::optional<PointAndNormal> plane_from_nested(const NestedList& list) {
  std::optional<ExactPlane> plane;
  if (const auto numbers = doubles<4>(list)) {
    plane = ExactPlane::from_distance((*numbers)[0], {(*numbers)[1], (*numbers)[2], (*numbers)[3]});
  } else if (list.is_list() && list.elements().size() == 2) {
    const auto point = triple(list.elements()[0]);
    const auto normal = triple(list.elements()[1]);
    if (point && normal) plane = ExactPlane::through(*point, *normal);
  }
  if (!plane) return std::nullopt;
  return PointAndNormal{plane->offset / dot(plane->normal, plane->normal) * plane->normal, plane->normal};
}

NestedList plane_to_nested(const PointAndNormal& plane) {
  return NestedList::list(algebra3d::triple_to_nested(plane.point), algebra3d::triple_to_nested(plane.normal));
}

// Applies `change` to every element; nothing if one of them gives nothing.
template <typename Change>
std::optional<NestedList> each(const NestedList& list, Change change) {
  if (!list.is_list()) return std::nullopt;
  NestedList::List changed;
  changed.reserve(list.elements().size());
  for (const NestedList& element : list.elements()) {
    auto result = change(element);
    if (!result) return std::nullopt;
    changed.push_back(std::move(*result));
  }
  return NestedList(std::move(changed));
}

// Applies `change` to the values in relations, attribute by attribute, and to any other value itself. Recursion follows
// the nesting of relations, which is bounded.
template <typename Change>
NestedList each_value(const TypeExpr& type, const NestedList& list, Change change) {
  if (!type.is_relation() && !type.is_nested_relation()) return change(type, list);
  const auto& attributes = type.element().attributes();
  auto rows = each(list, [&](const NestedList& row) -> std::optional<NestedList> {
    if (!row.is_list() || row.elements().size() != attributes.size()) return std::nullopt;
    NestedList::List values;
    for (std::size_t i = 0; i < attributes.size(); ++i)
      values.push_back(each_value(attributes[i].type, row.elements()[i], change));
    return NestedList(std::move(values));
  });
  return rows ? std::move(*rows) : list;
}

void sort_by_text(NestedList::List& lists) {
  std::ranges::sort(lists, {}, [](const NestedList& list) { return list.print(); });
}

NestedList value_without_frame(Coordinates coordinates, const NestedList& list) {
  if (list.is_undefined()) return list;
  if (coordinates == Coordinates::plane) {
    const auto plane = plane_from_nested(list);
    return plane ? plane_to_nested(*plane) : list;
  }
  const bool has_triangles = coordinates == Coordinates::triangles;
  if (!list.is_list() || !(has_triangles || coordinates == Coordinates::points)) return list;
  NestedList result = list;
  for (NestedList& triangle : result.elements()) {
    if (!has_triangles || !triangle.is_list()) continue;
    auto& corners = triangle.elements();
    const auto first = std::ranges::min_element(corners, {}, [](const NestedList& corner) { return corner.print(); });
    std::rotate(corners.begin(), first, corners.end());
  }
  sort_by_text(result.elements());
  return result;
}

bool is_type_with_geometry(const Registry& types, const NestedList& list) {
  const auto type = TypeExpr::from_nested(list);
  return type &&
         (type->is_relation() || type->is_nested_relation() || coordinates_of(types, *type) != Coordinates::none);
}

/// Where in a list the type and the value of a constant stand.
struct ConstantPlaces {
  std::size_t type, value;
};

std::optional<ConstantPlaces> constant_places(const Registry& types, const NestedList::List& items) {
  if (items.size() == 2 && is_type_with_geometry(types, items[0])) return ConstantPlaces{0, 1};
  if (items.size() == 4 && items[0].is_symbol("const") && items[2].is_symbol("value")) return ConstantPlaces{1, 3};
  if (items.size() >= 5 && items[0].is_symbol("OBJECT")) return ConstantPlaces{3, 4};
  return std::nullopt;
}

}  // namespace

Motion Motion::translation(const Registry& types, const Vec3& offset) {
  Motion motion;
  motion.types_ = &types;
  motion.offset_ = offset;
  return motion;
}

Motion Motion::turned_axes(const Registry& types) {
  Motion motion;
  motion.types_ = &types;
  motion.source_ = {2, 0, 1};
  return motion;
}

Motion Motion::inverse() const {
  Motion result;
  result.types_ = types_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.source_[source_[axis]] = axis;
    result.offset_[source_[axis]] = -offset_[axis];
  }
  return result;
}

bool Motion::moves(const algebra3d::Type& type) {
  return type.coordinates() != Coordinates::none;
}

NestedList Motion::image(const TypeExpr& type, const NestedList& list) const {
  if (types_ == nullptr) return list;
  return each_value(type, list, [this](const TypeExpr& value_type, const NestedList& value) -> NestedList {
    if (value.is_undefined()) return value;
    auto image = moved(coordinates_of(*types_, value_type), value);
    if (!image) return value;
    return std::move(*image);
  });
}

// Its depth is limited by the reader of nested lists.
NestedList Motion::image_of_constants(const NestedList& form) const {
  if (!form.is_list() || types_ == nullptr) return form;
  NestedList image_of_form = form;
  auto& items = image_of_form.elements();
  if (const auto places = constant_places(*types_, items)) {
    const auto type = TypeExpr::from_nested(items[places->type]);
    NestedList& value = items[places->value];
    if (type) value = type->is_function() ? image_of_constants(value) : image(*type, value);
    return image_of_form;
  }
  for (NestedList& item : items) item = image_of_constants(item);
  return image_of_form;
}

Motion::Moved Motion::moved(Coordinates coordinates, const NestedList& list) const {
  switch (coordinates) {
    case Coordinates::none:
      return std::nullopt;
    case Coordinates::point:
      return point_list(list);
    case Coordinates::direction:
      return direction_list(list);
    case Coordinates::points:
      return points(list);
    case Coordinates::triangles:
      return triangles(list);
    case Coordinates::mesh:
      return mesh(list);
    case Coordinates::plane:
      return plane(list);
    case Coordinates::box:
      return box(list);
  }
  return std::nullopt;
}

RationalVec3 Motion::direction(const RationalVec3& v) const {
  return {v[source_[0]], v[source_[1]], v[source_[2]]};
}

RationalVec3 Motion::point(const RationalVec3& p) const {
  return direction(p) + RationalVec3(offset_);
}

Motion::Moved Motion::point_list(const NestedList& list) const {
  const auto p = triple(list);
  if (!p) return std::nullopt;
  return algebra3d::triple_to_nested(point(*p));
}

Motion::Moved Motion::direction_list(const NestedList& list) const {
  const auto v = triple(list);
  if (!v) return std::nullopt;
  return algebra3d::triple_to_nested(direction(*v));
}

Motion::Moved Motion::points(const NestedList& list) const {
  return each(list, [this](const NestedList& p) { return point_list(p); });
}

Motion::Moved Motion::triangles(const NestedList& list) const {
  return each(list, [this](const NestedList& triangle) -> Moved {
    if (!triangle.is_list() || triangle.elements().size() != 3) return std::nullopt;
    return points(triangle);
  });
}

// Attributes stay: a case in which vectors are to turn says so.
Motion::Moved Motion::mesh(const NestedList& list) const {
  if (!list.is_list() || list.elements().size() < 2) return std::nullopt;
  auto moved = points(list.elements()[0]);
  if (!moved) return std::nullopt;
  NestedList::List parts = list.elements();
  parts[0] = *std::move(moved);
  return NestedList(std::move(parts));
}

// The distance of a moved plane is not a double as a rule; the form with a point is exact. Where the origin stays, the
// form with a distance is kept, because that is what is compared with.
Motion::Moved Motion::plane(const NestedList& list) const {
  const auto given = plane_from_nested(list);
  if (!given) return std::nullopt;
  if (list.elements().size() == 4 && offset_ == Vec3{}) {
    NestedList::List quadruple = {list.elements()[0]};
    for (const std::size_t axis : source_) quadruple.push_back(list.elements()[axis + 1]);
    return NestedList(std::move(quadruple));
  }
  // Of a plane that is given by a point it is that point that moves, since it is printed.
  const auto written = list.elements().size() == 2 ? triple(list.elements()[0]) : std::nullopt;
  return plane_to_nested({point(written ? *written : given->point), direction(given->normal)});
}

Motion::Moved Motion::box(const NestedList& list) const {
  const auto bounds = doubles<6>(list);
  if (!bounds) return std::nullopt;
  NestedList::List moved;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t side = 0; side < 2; ++side)
      moved.emplace_back((*bounds)[2 * source_[axis] + side] + offset_[axis]);
  return NestedList(std::move(moved));
}

NestedList frame_free(const Registry& types, const TypeExpr& type, const NestedList& list) {
  return each_value(type, list, [&](const TypeExpr& value_type, const NestedList& value) {
    return value_without_frame(coordinates_of(types, value_type), value);
  });
}

}  // namespace queries
