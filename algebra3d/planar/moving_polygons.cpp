#include "algebra3d/planar/moving_polygons.h"

#include <cassert>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/base/number_text.h"
#include "algebra3d/planar/moving_pairs.h"
#include "algebra3d/planar/moving_segments.h"

// The proof. Every two segments are looked at over the whole time: none vanishes, those of one cycle never meet,
// neighbours never lie on each other, those of different cycles neither cross nor overlap. What is left then is how the
// cycles lie to each other, and that is looked at in the middle of the time, since it cannot change: where two curves
// change from touching to crossing, they cross in two segments, or they overlap, at that time or right after it.

namespace algebra3d {
namespace {

std::string coordinate_text(const PointRef& point, std::size_t axis) {
  const Rational number = point.coordinate(axis);
  return number.is_double() ? real_text(number.nearest_double()) : number.text();
}

std::string corner_text(const MovingPoint& corner) {
  return fmt::format("({} {} {} {})", coordinate_text(corner.start, 0), coordinate_text(corner.start, 1),
                     coordinate_text(corner.end, 0), coordinate_text(corner.end, 1));
}

std::string time_text(const Moment& moment) {
  const double s = moment.s.approx();
  if (!moment.is_right_after) return fmt::format("at about {:.6g} of the unit", s);
  return s == 0 ? "from its start on" : fmt::format("from about {:.6g} of the unit on", s);
}

/// The segments of moving polygons: number i leads from corner i to the next one of its cycle.
class SegmentCheck {
 public:
  explicit SegmentCheck(const MovingPolygons& moving) : polygons_(moving.start) {
    for (std::size_t cycle = 0; cycle < polygons_.cycle_count(); ++cycle) {
      const std::uint32_t first = polygons_.first_corner(cycle);
      const std::uint32_t end = polygons_.cycle_ends[cycle];
      for (std::uint32_t i = first; i < end; ++i) {
        const std::uint32_t next = i + 1 == end ? first : i + 1;
        segments_.push_back(
            {{moving.start.corners[i], moving.end.corners[i]}, {moving.start.corners[next], moving.end.corners[next]}});
        next_.push_back(next);
        cycle_of_.push_back(static_cast<std::uint32_t>(cycle));
      }
    }
  }

  Result<std::optional<std::string>> defect(const Monitor& monitor) const {
    if (auto found = short_cycle()) return found;
    if (auto found = defect_alone()) return found;
    return defect_of_pairs(monitor);
  }

 private:
  std::optional<std::string> short_cycle() const {
    for (std::size_t cycle = 0; cycle < polygons_.cycle_count(); ++cycle)
      if (polygons_.cycle_ends[cycle] - polygons_.first_corner(cycle) < 3)
        return fmt::format("{} has less than 3 corners", cycle_text(cycle));
    return std::nullopt;
  }

  /// What is wrong with a segment, or with a segment and the next one.
  std::optional<std::string> defect_alone() const {
    for (std::uint32_t i = 0; i < segments_.size(); ++i)
      if (const auto moment = vanishing(segments_[i]))
        return fmt::format("the segment {} has no length {}", segment_text(i), time_text(*moment));
    for (std::uint32_t i = 0; i < segments_.size(); ++i) {
      const MovingSegment& next = segments_[next_[i]];
      if (surely_unfolded(segments_[i].from, next.from, next.to)) continue;
      if (const auto moment = first_fold(segments_[i].from, next.from, next.to))
        return fmt::format("the segments {} and {} lie on each other {}", segment_text(i), segment_text(next_[i]),
                           time_text(*moment));
    }
    return std::nullopt;
  }

  Result<std::optional<std::string>> defect_of_pairs(const Monitor& monitor) const {
    Stage stage(monitor, "comparing moving segments", 0);
    std::optional<std::string> found;
    bool is_cancelled = false;
    MovingPairs(segments_).for_each([&](std::uint32_t i, std::uint32_t j) {
      is_cancelled = !stage.begin_step();
      if (!is_cancelled) found = defect_of_pair(i, j);
      return !is_cancelled && !found;
    });
    if (is_cancelled) return Monitor::interrupted();
    return found;
  }

  std::optional<std::string> defect_of_pair(std::uint32_t i, std::uint32_t j) const {
    const bool is_one_cycle = cycle_of_[i] == cycle_of_[j];
    if (is_one_cycle && (next_[i] == j || next_[j] == i)) return std::nullopt;
    if (surely_apart(segments_[i], segments_[j])) return std::nullopt;
    const auto clash = first_clash(segments_[i], segments_[j], !is_one_cycle);
    if (!clash) return std::nullopt;
    const char* const verb = clash->meeting == Meeting::crossing  ? "cross"
                             : clash->meeting == Meeting::overlap ? "overlap"
                                                                  : "touch";
    return fmt::format("the segments {} and {} {} {}", segment_text(i), segment_text(j), verb,
                       time_text(clash->moment));
  }

  std::string cycle_text(std::size_t cycle) const {
    std::size_t face = 0;
    while (polygons_.face_ends[face] <= cycle) ++face;
    return fmt::format("face {}, cycle {}", face + 1, cycle - polygons_.first_cycle(face) + 1);
  }
  std::string segment_text(std::uint32_t i) const {
    return fmt::format("{} to {} of {}", corner_text(segments_[i].from), corner_text(segments_[i].to),
                       cycle_text(cycle_of_[i]));
  }

  const Polygons& polygons_;
  std::vector<MovingSegment> segments_;
  std::vector<std::uint32_t> next_;      // of each segment: the next one of its cycle
  std::vector<std::uint32_t> cycle_of_;  // of each segment
};

}  // namespace

Polygons at(const MovingPolygons& moving, const Rational& s) {
  assert(s >= 0 && s <= 1);
  if (s == 0) return moving.start;
  if (s == 1) return moving.end;
  Polygons result;
  result.cycle_ends = moving.start.cycle_ends;
  result.face_ends = moving.start.face_ends;
  result.corners.reserve(moving.start.corners.size());
  for (std::size_t i = 0; i < moving.start.corners.size(); ++i) {
    const PointRef start = moving.start.corners[i];
    const PointRef end = moving.end.corners[i];
    const auto coordinate = [&](std::size_t axis) {
      const Rational from = start.coordinate(axis);
      return from + (end.coordinate(axis) - from) * s;
    };
    result.corners.push_back(ExactPoint(RationalVec3(coordinate(0), coordinate(1), 0)));
  }
  return result;
}

Result<std::optional<std::string>> moving_polygon_defect(const MovingPolygons& moving, const Monitor& monitor) {
  assert(moving.start.cycle_ends == moving.end.cycle_ends && moving.start.face_ends == moving.end.face_ends);
  assert(moving.start.corners.size() == moving.end.corners.size());
  ASSIGN_OR_RETURN(auto defect, SegmentCheck(moving).defect(monitor));
  return defect;
}

}  // namespace algebra3d
