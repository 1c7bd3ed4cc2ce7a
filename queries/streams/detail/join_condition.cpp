#include "queries/streams/detail/join_condition.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/values/spatial_relations/nearest_points.h"
#include "algebra3d/values/spatial_relations/place_of_box.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"

namespace queries {
namespace {

using algebra3d::Box3;
using algebra3d::Monitor;
using algebra3d::SpatialSet;

Result<bool> lies_inside(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor) {
  return is_inside(a, b, monitor);
}
Result<bool> lies_around(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor) {
  return is_inside(b, a, monitor);
}

bool may_be_inside(const Box3& a, const Box3& b) {
  return b.contains(a);
}
bool may_contain(const Box3& a, const Box3& b) {
  return a.contains(b);
}
bool may_meet(const Box3& a, const Box3& b) {
  return a.intersects(b);
}

struct SpatialPredicate {
  std::string_view name;
  bool is_symmetric;
  /// False if the predicate does not hold of any sets with these boxes.
  bool (*may_hold)(const Box3& a, const Box3& b);
  Result<bool> (*holds)(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor);
  /// Whether it holds if the first set is in the interior of the second one, and the other way round.
  bool holds_in_interior, holds_around_interior;
};

constexpr std::array<SpatialPredicate, 7> kPredicates{
    {{"intersects", true, may_meet, algebra3d::do_meet, true, true},
     {"touches", true, may_meet, algebra3d::do_touch, false, false},
     {"inside", false, may_be_inside, lies_inside, true, false},
     {"contains", false, may_contain, lies_around, false, true},
     {"covers", false, may_contain, lies_around, false, true},
     {"coveredBy", false, may_be_inside, lies_inside, true, false},
     {"overlaps", true, may_meet, algebra3d::do_overlap, false, false}}};

const SpatialPredicate* find_predicate(std::string_view name) {
  const auto* const found = std::ranges::find(kPredicates, name, &SpatialPredicate::name);
  return found == kPredicates.end() ? nullptr : found;
}

}  // namespace

std::string predicate_names() {
  std::string names;
  for (const SpatialPredicate& predicate : kPredicates) names.append(names.empty() ? "" : ", ").append(predicate.name);
  return names;
}

Result<std::string> predicate_name(const MappingCheck& check, std::size_t place) {
  A3D_TRY(check.characters(place));
  if (!check[place].constant) return check.error("expected a constant as the name of the predicate");
  A3D_ASSIGN(const Value value, check[place].constant());
  const std::string name = value.is_defined() ? algebra3d::characters_of(value) : std::string("undefined");
  if (find_predicate(name) == nullptr)
    return check.error(fmt::format("expected a predicate: {}; got '{}'", predicate_names(), name));
  return name;
}

PairTest predicate_test(const std::string& name, bool in_both_orders) {
  const SpatialPredicate* const predicate = find_predicate(name);
  const bool tries_turned = in_both_orders && !predicate->is_symmetric;
  PairTest test;
  test.by_boxes = [=](const Box3& a, const Box3& b) -> std::optional<PairVerdict> {
    if (predicate->may_hold(a, b) || (tries_turned && predicate->may_hold(b, a))) return std::nullopt;
    return PairVerdict::no;
  };
  test.by_one_box = [=](const Box3& box, bool is_box_of_first, const SpatialSet& other) -> std::optional<PairVerdict> {
    const algebra3d::PlaceOfBox place = place_of_box(box, other, 0);
    if (place.gap == 0) return std::nullopt;
    if (!place.is_inside) return PairVerdict::no;
    const bool holds = is_box_of_first ? predicate->holds_in_interior : predicate->holds_around_interior;
    if (holds || !tries_turned) return holds ? PairVerdict::yes : PairVerdict::no;
    const bool holds_turned = is_box_of_first ? predicate->holds_around_interior : predicate->holds_in_interior;
    return holds_turned ? PairVerdict::turned : PairVerdict::no;
  };
  test.by_geometry = [=](const SpatialSet& a, const SpatialSet& b, const Monitor& monitor) -> Result<PairVerdict> {
    A3D_ASSIGN(const bool holds, predicate->holds(a, b, monitor));
    if (holds || !tries_turned) return holds ? PairVerdict::yes : PairVerdict::no;
    A3D_ASSIGN(const bool holds_turned, predicate->holds(b, a, monitor));
    return holds_turned ? PairVerdict::turned : PairVerdict::no;
  };
  return test;
}

PairTest distance_test(const Value& limit) {
  const double most = limit.is_defined() ? limit.get<double>() : -1;
  const auto verdict = [](bool is_near) { return is_near ? PairVerdict::yes : PairVerdict::no; };
  PairTest test;
  test.by_boxes = [=](const Box3& a, const Box3& b) -> std::optional<PairVerdict> {
    const std::optional<bool> answer = algebra3d::are_within_by_boxes(a, b, most);
    return answer ? std::optional(verdict(*answer)) : std::nullopt;
  };
  test.by_one_box = [=](const Box3& box, bool, const SpatialSet& other) -> std::optional<PairVerdict> {
    const algebra3d::PlaceOfBox place = place_of_box(box, other, most);
    if (place.is_inside) return PairVerdict::yes;
    return place.gap > most ? std::optional(PairVerdict::no) : std::nullopt;
  };
  test.by_geometry = [=](const SpatialSet& a, const SpatialSet& b, const Monitor& monitor) -> Result<PairVerdict> {
    A3D_ASSIGN(const bool is_near, are_within(a, b, algebra3d::Rational(most), monitor));
    return verdict(is_near);
  };
  return test;
}

WindowOfBox distance_window(const Value& limit) {
  const bool is_some = limit.is_defined() && limit.get<double>() >= 0;
  return [is_some, by = is_some ? limit.get<double>() : 0](const Box3& box) {
    return is_some ? algebra3d::padded(box, by) : Box3();
  };
}

Status check_operands(const algebra3d::Registry& registry, std::string_view name, std::span<const TypeExpr> types) {
  const auto call = registry.resolve(*registry.find_operator(name), types);
  return call ? Status() : Status(call.error());
}

}  // namespace queries
