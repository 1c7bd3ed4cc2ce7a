// atinstant, deftime, initial, final, units: regions that move.
#include <vector>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/moving_region.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

Result<Maybe<Region>> region_of_unit(Context& context, const RegionUnit& unit, Instant instant) {
  A3D_ASSIGN(Region region, unit.at(instant, context.monitor()));
  return Maybe<Region>(std::move(region));
}

Result<Maybe<Region>> at_instant(Context& context, const MovingRegion& moving, const Instant& instant) {
  if (const RegionUnit* const unit = moving.unit_at(instant)) return region_of_unit(context, *unit, instant);
  return Maybe<Region>(Undefined{"there is no region at " + instant_text(instant)});
}
Result<Maybe<Region>> unit_at_instant(Context& context, const RegionUnit& unit, const Instant& instant) {
  if (unit.interval().contains(instant)) return region_of_unit(context, unit, instant);
  return Maybe<Region>(Undefined{"there is no region at " + instant_text(instant)});
}

Result<Maybe<Region>> initial_region(Context& context, const MovingRegion& moving) {
  if (moving.units().empty()) return Maybe<Region>(Undefined{"it has no unit"});
  const RegionUnit& first = moving.units().front();
  return region_of_unit(context, first, first.interval().start);
}
Result<Maybe<Region>> final_region(Context& context, const MovingRegion& moving) {
  if (moving.units().empty()) return Maybe<Region>(Undefined{"it has no unit"});
  const RegionUnit& last = moving.units().back();
  return region_of_unit(context, last, last.interval().end);
}

TimeInterval interval_of_unit(const RegionUnit& unit) {
  return unit.interval();
}
std::vector<TimeInterval> times_of(const MovingRegion& moving) {
  return moving.times();
}
std::vector<RegionUnit> units_of(const MovingRegion& moving) {
  return moving.units();
}

// A square that goes one to the right within a day, and from then on vanishes into its middle.
const std::string kUnitA = "((0 1 TRUE FALSE) ((((0 0 1 0) (2 0 3 0) (2 2 3 2) (0 2 1 2)))))";
const std::string kUnitB = "((1 2 TRUE TRUE) ((((1 0 2 1) (3 0 2 1) (3 2 2 1) (1 2 2 1)))))";
const std::string kSquareOnItsWay =
    "(mregion (((0 1 TRUE FALSE) ((((0 0 1 0) (2 0 3 0) (2 2 3 2) (0 2 1 2))))) ((1 2 TRUE TRUE) ((((1 0 2 1) (3 0 2 "
    "1) (3 2 2 1) (1 2 2 1)))))))";
const std::string kNeverDefined = "(mregion undefined)";

void register_states(OperatorGroup& group) {
  group.add({
      .name = "atinstant",
      .syntax = "atinstant(_, _)",
      .doc = "The region of a moving region at an instant.",
      .detail =
          "Undefined at instants at which the moving region is undefined. Parts that collapse or overlap at the end "
          "of a unit are dropped.",
      .exactness = Exactness::exact,
      .overloads = {overload<&at_instant>("moving", "instant"), overload<&unit_at_instant>("unit", "instant")},
      .examples = {{{kSquareOnItsWay, "(instant 0.5)"}, "((((0.5 0.0) (2.5 0.0) (2.5 2.0) (0.5 2.0))))"},
                   {{kSquareOnItsWay, "(instant 2)"}, "()"},
                   {{kSquareOnItsWay, "(instant 3)"}, "undefined"},
                   {{kNeverDefined, "(instant 0)"}, "undefined"}},
      .errors = {{{kSquareOnItsWay, "0.5"},
                  "atinstant: expected (mregion instant) or (uregion instant), got (mregion real)"}},
  });
  group.add({
      .name = "initial",
      .syntax = "initial(_)",
      .doc = "The region of a moving region at its beginning.",
      .detail = "If the beginning is not included, the limit there. Undefined without a unit.",
      .exactness = Exactness::exact,
      .overloads = {overload<&initial_region>("moving")},
      .examples = {{{kSquareOnItsWay}, "((((0.0 0.0) (2.0 0.0) (2.0 2.0) (0.0 2.0))))"},
                   {{"(mregion ())"}, "undefined"},
                   {{kNeverDefined}, "undefined"}},
      .errors = {{{"1"}, "initial: expected (mregion), got (int)"}},
  });
  group.add({
      .name = "final",
      .syntax = "final(_)",
      .doc = "The region of a moving region at its end.",
      .detail = "If the end is not included, the limit there. Undefined without a unit.",
      .exactness = Exactness::exact,
      .overloads = {overload<&final_region>("moving")},
      .examples = {{{"(mregion (((0 1 TRUE FALSE) ((((0 0 1 0) (2 0 3 0) (2 2 3 2) (0 2 1 2)))))))"},
                    "((((1.0 0.0) (3.0 0.0) (3.0 2.0) (1.0 2.0))))"},
                   {{kSquareOnItsWay}, "()"},
                   {{kNeverDefined}, "undefined"}},
      .errors = {{{"1"}, "final: expected (mregion), got (int)"}},
  });
}

}  // namespace

void register_moving_regions(OperatorGroup& group) {
  register_states(group);
  group.add({
      .name = "deftime",
      .syntax = "deftime(_)",
      .doc = "The interval of a unit, or the intervals during which a moving region is defined.",
      .detail = "Adjacent intervals are joined; they are in order of time.",
      .exactness = Exactness::exact,
      .overloads = {overload<&interval_of_unit>("unit"), overload<&times_of>("moving")},
      .examples = {{{"(uregion ((0 1 TRUE FALSE) ((((0 0 1 0) (2 0 3 0) (2 2 3 2) (0 2 1 2))))))"},
                    R"(("2000-01-03" "2000-01-04" TRUE FALSE))"},
                   {{kSquareOnItsWay}, "1", "(count _)"},
                   {{"(uregion undefined)"}, "undefined"}},
      .errors = {{{"1"}, "deftime: expected (uregion) or (mregion), got (int)"}},
  });
  group.add({
      .name = "units",
      .syntax = "units(_)",
      .doc = "The units of a moving region in order of time.",
      .exactness = Exactness::exact,
      .overloads = {overload<&units_of>("moving")},
      .examples = {{{kSquareOnItsWay}, "2", "(count _)"}, {{kNeverDefined}, "0", "(count _)"}},
      .errors = {{{"1"}, "units: expected (mregion), got (int)"}},
  });
}

}  // namespace algebra3d
