#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/planar/moving_polygons.h"
#include "algebra3d/types/planar.h"
#include "algebra3d/types/time.h"
#include "algebra3d/types/value.h"

namespace algebra3d {

/// uregion: a region that moves over an interval, each corner evenly. Valid by construction: at every time between the
/// ends of the interval the polygons bound a region (moving_polygons.h); at the ends themselves parts may have
/// collapsed. Over a single instant nothing moves. Outer cycles run counter-clockwise, holes clockwise; corners and
/// cycles keep the order that they were given. Immutable, cheap to copy. Equal means: the same interval, and the same
/// cycles of moving corners, wherever they begin and in whatever order.
class RegionUnit {
 public:
  /// Undefined, with segments and time named, if it is no valid unit. Exact. Errors: interrupted. Cost: n log n.
  static Result<Maybe<RegionUnit>> prove(const TimeInterval& interval, const MovingPolygons& polygons,
                                         const Monitor& monitor = {});
  /// Takes oriented polygons without a proof: those that were proved before they were stored, or made to be valid.
  static RegionUnit trusted(const TimeInterval& interval, MovingPolygons polygons);

  const TimeInterval& interval() const;
  const MovingPolygons& polygons() const;
  std::size_t segment_count() const { return polygons().start.corners.size(); }
  const Box3& box() const;  ///< of all times; outward-rounded, flat at z = 0
  /// The same for equal units of one interval: every cycle from its smallest moving corner on, all in a fixed order.
  const MovingPolygons& canonical() const;
  std::size_t heap_bytes() const;

  /// The region at an instant of the interval, or at one of its ends even if it is open there. What has collapsed at an
  /// end is dropped, and segments that lie on each other there bound nothing. Exact. Errors: interrupted.
  Result<Region> at(Instant instant, const Monitor& monitor = {}) const;

  friend std::strong_ordering operator<=>(const RegionUnit& a, const RegionUnit& b);
  friend bool operator==(const RegionUnit& a, const RegionUnit& b) { return (a <=> b) == 0; }
  std::size_t hash() const;

 private:
  struct Content;
  explicit RegionUnit(std::shared_ptr<const Content> content) : content_(std::move(content)) {}
  std::shared_ptr<const Content> content_;
};

/// mregion: a region that changes in the course of time, as units in the order of time. Their intervals have no instant
/// in common; at instants that belong to none it is undefined. Cheap to copy. Equal means: equal units.
class MovingRegion {
 public:
  MovingRegion() = default;  ///< never defined: no unit
  /// Undefined, with the units named, if they are out of order or two of them share an instant.
  static Maybe<MovingRegion> make(std::vector<RegionUnit> units);

  const std::vector<RegionUnit>& units() const { return *units_; }
  /// The unit whose interval contains the instant, or null.
  const RegionUnit* unit_at(Instant instant) const;
  /// The times at which it is defined: maximal intervals in order.
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
