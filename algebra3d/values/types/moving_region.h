#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/planar/moving_polygons.h"
#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/time.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d {

/// uregion: a region that moves over an interval, each corner linearly. Valid by construction: at every time between
/// the ends of the interval the polygons bound a region (moving_polygons.h); at the ends parts may have collapsed. Over
/// a single instant nothing moves. Outer cycles run counter-clockwise, holes clockwise; corners and cycles keep their
/// order. Immutable, cheap to copy. Units are equal if they have the same interval and the same cycles of moving
/// corners, in any order and from any first corner.
class RegionUnit {
 public:
  /// Proves a unit; undefined, with segments and time, if it is not valid. Exact. Errors: interrupted. Cost: n log n.
  static Result<Maybe<RegionUnit>> prove(const TimeInterval& interval, const MovingPolygons& polygons,
                                         const Monitor& monitor = {});
  /// Takes oriented polygons without a proof: polygons that were proved before storing, or are valid by construction.
  static RegionUnit trusted(const TimeInterval& interval, MovingPolygons polygons);

  const TimeInterval& interval() const;
  const MovingPolygons& polygons() const;
  std::size_t segment_count() const { return polygons().start.corners.size(); }
  const Box3& box() const;  ///< of all times; outward-rounded, flat at z = 0
  /// The canonical form: every cycle begins at its smallest moving corner, cycles and faces are in a fixed order.
  const MovingPolygons& canonical() const;
  std::size_t heap_bytes() const;

  /// The region at an instant of the interval, or at an end, also an open one. Parts that have collapsed at an end and
  /// segments that overlap there are dropped. Exact. Errors: interrupted.
  Result<Region> at(Instant instant, const Monitor& monitor = {}) const;

  friend std::strong_ordering operator<=>(const RegionUnit& a, const RegionUnit& b);
  friend bool operator==(const RegionUnit& a, const RegionUnit& b) { return (a <=> b) == 0; }
  std::size_t hash() const;

 private:
  struct Content;
  explicit RegionUnit(std::shared_ptr<const Content> content) : content_(std::move(content)) {}
  std::shared_ptr<const Content> content_;
};

/// mregion: a region that changes over time, as a list of units in order of time with disjoint intervals; undefined at
/// all other instants. Cheap to copy. Equal if the units are equal.
class MovingRegion {
 public:
  MovingRegion() = default;  ///< without units: undefined at all times
  /// Undefined, with the units, if they are out of order or two of them share an instant.
  static Maybe<MovingRegion> make(std::vector<RegionUnit> units);

  const std::vector<RegionUnit>& units() const { return *units_; }
  /// The unit whose interval contains the instant, or null.
  const RegionUnit* unit_at(Instant instant) const;
  /// The times of definition: maximal intervals in order.
  std::vector<TimeInterval> times() const;

 private:
  std::shared_ptr<const std::vector<RegionUnit>> units_ = std::make_shared<const std::vector<RegionUnit>>();
};

template <>
struct TypeOf<RegionUnit> {
  static const Type& type();
};
template <>
struct TypeOf<MovingRegion> {
  static const Type& type();
};

}  // namespace algebra3d
