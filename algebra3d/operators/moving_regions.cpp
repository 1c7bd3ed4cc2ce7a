// atinstant, deftime, initial, final, units: regions that move.
#include <vector>

#include "algebra3d/operators/all.h"
#include "algebra3d/registry/overload.h"
#include "algebra3d/types/moving_region.h"

namespace algebra3d {
namespace {

Result<Maybe<Region>> region_of_unit(Context& context, const RegionUnit& unit, Instant instant) {
  ASSIGN_OR_RETURN(Region region, unit.at(instant, context.monitor()));
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
const std::string kSquareOnItsWay = "[const mregion value (" + kUnitA + " " + kUnitB + ")]";
const std::string kNeverDefined = "[const mregion value undefined]";

void register_states(Registry& registry) {
  registry.add({
      .name = "atinstant",
      .syntax = "atinstant(_, _)",
      .doc = "What a moving region is at an instant.",
      .detail =
          "Undefined at instants that do not belong to it. Where parts collapse or come to lie on each other at the "
          "end of a unit they bound nothing.",
      .exactness = Exactness::exact,
      .overloads = {overload<&at_instant>("moving", "instant"), overload<&unit_at_instant>("unit", "instant")},
      .examples = {{"atinstant(" + kSquareOnItsWay + ", [const instant value 0.5])",
                    "((((0.5 0.0) (2.5 0.0) (2.5 2.0) (0.5 2.0))))"},
                   {"atinstant(" + kSquareOnItsWay + ", [const instant value 2])", "()"},
                   {"atinstant(" + kSquareOnItsWay + ", [const instant value 3])", "undefined"},
                   {"atinstant(" + kNeverDefined + ", [const instant value 0])", "undefined"}},
      .errors = {{"query atinstant(" + kSquareOnItsWay + ", 0.5)",
                  "atinstant: expected (mregion instant) or (uregion instant), got (mregion real)"}},
  });
  registry.add({
      .name = "initial",
      .syntax = "initial(_)",
      .doc = "What a moving region is at its beginning.",
      .detail = "If the beginning does not belong to it, what it comes from there. Undefined without a unit.",
      .exactness = Exactness::exact,
      .overloads = {overload<&initial_region>("moving")},
      .examples = {{"initial(" + kSquareOnItsWay + ")", "((((0.0 0.0) (2.0 0.0) (2.0 2.0) (0.0 2.0))))"},
                   {"initial([const mregion value ()])", "undefined"},
                   {"initial(" + kNeverDefined + ")", "undefined"}},
      .errors = {{"query initial(1)", "initial: expected (mregion), got (int)"}},
  });
  registry.add({
      .name = "final",
      .syntax = "final(_)",
      .doc = "What a moving region is at its end.",
      .detail = "If the end does not belong to it, what it comes to there. Undefined without a unit.",
      .exactness = Exactness::exact,
      .overloads = {overload<&final_region>("moving")},
      .examples = {{"final([const mregion value (" + kUnitA + ")])", "((((1.0 0.0) (3.0 0.0) (3.0 2.0) (1.0 2.0))))"},
                   {"final(" + kSquareOnItsWay + ")", "()"},
                   {"final(" + kNeverDefined + ")", "undefined"}},
      .errors = {{"query final(1)", "final: expected (mregion), got (int)"}},
  });
}

}  // namespace

void register_moving_regions(Registry& registry) {
  register_states(registry);
  registry.add({
      .name = "deftime",
      .syntax = "deftime(_)",
      .doc = "The interval of a unit, or the times at which a moving region is defined, as a stream of intervals.",
      .detail = "Intervals that meet are one; they come in the order of time.",
      .exactness = Exactness::exact,
      .overloads = {overload<&times_of>("moving"), overload<&interval_of_unit>("unit")},
      .examples = {{"deftime([const uregion value " + kUnitA + "])", R"(("2000-01-03" "2000-01-04" TRUE FALSE))"},
                   {"deftime(" + kSquareOnItsWay + ") count", "1"},
                   {"deftime([const uregion value undefined])", "undefined"}},
      .errors = {{"query deftime(1)", "deftime: expected (mregion) or (uregion), got (int)"}},
  });
  registry.add({
      .name = "units",
      .syntax = "units(_)",
      .doc = "The units of a moving region in the order of time, as a stream.",
      .exactness = Exactness::exact,
      .overloads = {overload<&units_of>("moving")},
      .examples = {{"units(" + kSquareOnItsWay + ") count", "2"}, {"units(" + kNeverDefined + ") count", "0"}},
      .errors = {{"query units(1) count", "units: expected (mregion), got (int)"}},
  });
}

}  // namespace algebra3d
