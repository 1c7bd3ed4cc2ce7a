// mregion2volume: moving regions as solids in space and time.
#include <cmath>
#include <utility>
#include <vector>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/constructions/moving_solid.h"
#include "algebra3d/values/constructions/solid_sets.h"
#include "algebra3d/values/types/moving_region.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// Time as the third axis: 0 at the first instant, and so much a day. Each height is rounded once, so that units which
/// meet in time meet in space.
class TimeAxis {
 public:
  TimeAxis(Instant first, double height_per_day) : first_(first), height_per_day_(height_per_day) {}

  double height(Instant instant) const {
    const Rational days(instant.milliseconds - first_.milliseconds, kMillisecondsPerDay);
    return (days * height_per_day_).nearest_double();
  }

 private:
  Instant first_;
  Rational height_per_day_;
};

std::string unit_text(std::size_t number, const RegionUnit& unit) {
  return fmt::format("unit {} ({} to {})", number, instant_text(unit.interval().start),
                     instant_text(unit.interval().end));
}

/// Of a unit that lasts. Undefined with the reason if it sweeps no solid.
Result<Maybe<Volume3d>> solid_of_unit(const RegionUnit& unit, const TimeAxis& axis, const Monitor& monitor) {
  const MovingSlab slab{&unit.polygons(), axis.height(unit.interval().start), axis.height(unit.interval().end)};
  if (!std::isfinite(slab.to)) return Maybe<Volume3d>(Undefined{"its end is beyond the range of doubles"});
  if (!(slab.from < slab.to))
    return Maybe<Volume3d>(Undefined{"its height is too small to separate its end from its start"});
  A3D_ASSIGN(auto mesh, swept_solid(slab, monitor));
  if (!mesh) return Maybe<Volume3d>(Undefined{mesh.reason()});
  return Maybe<Volume3d>(Volume3d::trusted(*std::move(mesh)));
}

Result<Maybe<Volume3d>> solid_swept_by(Context& context, const MovingRegion& region, double height_per_day) {
  if (!(height_per_day > 0))
    return Maybe<Volume3d>(Undefined{fmt::format("the height of a day is {}; it must be positive", height_per_day)});
  const std::vector<RegionUnit>& units = region.units();
  if (units.empty()) return Maybe<Volume3d>(Volume3d());
  const TimeAxis axis(units.front().interval().start, height_per_day);
  std::vector<Volume3d> solids;
  Stage stage(context.monitor(), "solids of units", units.size());
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (!stage.begin_step()) return Monitor::interrupted();
    // A single instant sweeps nothing.
    if (units[i].interval().start == units[i].interval().end) continue;
    A3D_ASSIGN(auto solid, solid_of_unit(units[i], axis, context.monitor().silent()));
    if (!solid) return Maybe<Volume3d>(Undefined{unit_text(i + 1, units[i]) + ": " + solid.reason()});
    solids.push_back(*std::move(solid));
  }
  A3D_ASSIGN(Volume3d all, united(context, solids));
  return Maybe<Volume3d>(std::move(all));
}

const std::string kGrowing =
    R"((mregion ((("2011-07-08" "2011-07-10" TRUE FALSE) ((((1 1 0 0) (1 1 4 0) (1 1 4 4) (1 1 0 4))))))))";

}  // namespace

void register_space_time(OperatorGroup& group) {
  group.add({
      .name = "mregion2volume",
      .syntax = "mregion2volume(_, _)",
      .doc = "The solid that a moving region sweeps with time as the third axis; the second argument is the height "
             "of a day.",
      .detail =
          "The first unit starts at z = 0; gaps in time are gaps in height. Each height is rounded once. A unit is "
          "bounded by its regions at start and end, and by two triangles for each moving segment, or one if it "
          "begins or ends as a point; the diagonal begins at the lexicographically smaller start corner. If segments "
          "keep their directions, the solid's `slice` is the region at that time; if the vector of a segment changes "
          "by d from start to end, the error is at most |d| s (1 - s) at the fraction s of the unit. The solids of "
          "units are united. Units of a single instant sweep nothing. Undefined if the height of a day is not "
          "positive, and if the sides of a unit cross each other.",
      .exactness = Exactness::rounded_once,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&solid_swept_by>("moving", "heightPerDay")},
      // A pyramid: 1/3 * 16 * 2.
      .examples = {{{kGrowing, "1.5"}, "16.0", "(volume _)"},
                   {{kGrowing, "1"}, "TRUE", "(= (slice _ 1) (atinstant " + kGrowing + R"( (instant "2011-07-09"))))"},
                   {{"(mregion ())", "1"}, "TRUE", "(isEmpty _)"},
                   {{kGrowing, "0"}, "undefined"},
                   {{"(mregion undefined)", "1"}, "undefined"}},
      .errors = {{{kGrowing}, "mregion2volume: expected (mregion real), got (mregion)"}},
  });
}

}  // namespace algebra3d
