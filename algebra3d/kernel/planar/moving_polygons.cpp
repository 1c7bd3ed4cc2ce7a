#include "algebra3d/kernel/planar/moving_polygons.h"

#include <cassert>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/kernel/planar/detail/moving_pairs.h"
#include "algebra3d/kernel/planar/detail/moving_segments.h"
#include "algebra3d/kernel/planar/detail/polygon_places.h"
#include "algebra3d/kernel/planar/polygon_validity.h"
#include "algebra3d/kernel/planar/segment_text.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

// The proof. Every two segments are looked at over the whole time: none vanishes, those of one cycle never meet,
// neighbours never lie on each other, those of different cycles neither cross nor overlap. It remains to find how the
// cycles lie to each other; this is tested in the middle of the time, since it cannot change: where two curves change
// from touching to crossing, they cross in two segments, or they overlap, at that time or right after it.

namespace algebra3d {
namespace {

std::string time_text(const Moment& moment) {
  const double s = moment.s.approx();
  if (!moment.is_right_after) return fmt::format("at about {:.6g} of the unit", s);
  return s == 0 ? "from its start on" : fmt::format("from about {:.6g} of the unit on", s);
}

/// The segments of moving polygons: number i leads from corner i to the next one of its cycle.
class MovingCheck {
 public:
  explicit MovingCheck(const MovingPolygons& moving) : polygons_(moving.start), places_(moving.start) {
    const PointArray& start = moving.start.corners;
    const PointArray& end = moving.end.corners;
    segments_.reserve(start.size());
    for (std::uint32_t i = 0; i < start.size(); ++i) {
      const std::uint32_t next = places_.after(i);
      segments_.push_back({{start[i], end[i]}, {start[next], end[next]}});
    }
  }

  Result<std::optional<std::string>> defect(const Monitor& monitor) const {
    if (auto found = short_cycle()) return found;
    if (auto found = defect_alone()) return found;
    return defect_of_pairs(monitor);
  }

 private:
  std::optional<std::string> short_cycle() const {
    for (std::size_t face = 0; face < polygons_.face_count(); ++face)
      for (std::uint32_t cycle = polygons_.first_cycle(face); cycle < polygons_.face_ends[face]; ++cycle) {
        const std::uint32_t count = polygons_.cycle_ends[cycle] - polygons_.first_corner(cycle);
        if (count < 3)
          return fmt::format("face {}, cycle {} has {} corners, expected at least 3", face + 1,
                             cycle - polygons_.first_cycle(face) + 1, count);
      }
    return std::nullopt;
  }

  /// The defect of a segment, or of a segment and the next one.
  std::optional<std::string> defect_alone() const {
    for (std::uint32_t i = 0; i < segments_.size(); ++i) {
      poll_interruption_at(i);
      if (const auto moment = vanishing(segments_[i]))
        return fmt::format("{} has no length {}", segment_name(i), time_text(*moment));
    }
    for (std::uint32_t i = 0; i < segments_.size(); ++i) {
      poll_interruption_at(i);
      const std::uint32_t j = places_.after(i);
      const MovingSegment& next = segments_[j];
      if (surely_unfolded(segments_[i].from, next.from, next.to)) continue;
      if (const auto moment = first_fold(segments_[i].from, next.from, next.to))
        return fmt::format("{} and {} overlap {}", segment_name(i), segment_name(j), time_text(*moment));
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
    const bool is_one_cycle = places_.cycle_of(i) == places_.cycle_of(j);
    if (is_one_cycle && (places_.after(i) == j || places_.after(j) == i)) return std::nullopt;
    if (surely_apart(segments_[i], segments_[j])) return std::nullopt;
    const auto clash = first_clash(segments_[i], segments_[j], !is_one_cycle);
    if (!clash) return std::nullopt;
    const char* const verb = clash->intersection == SegmentIntersection::crossing  ? "cross"
                             : clash->intersection == SegmentIntersection::overlap ? "overlap"
                                                                                   : "touch";
    return fmt::format("{} and {} {} {}", segment_name(i), segment_name(j), verb, time_text(clash->moment));
  }

  std::string segment_name(std::uint32_t i) const {
    const auto& [from, to] = segments_[i];
    return fmt::format("segment {} moving to {} of {}", planar::segment_text(from.start, to.start),
                       planar::segment_text(from.end, to.end), places_.cycle_name(i));
  }

  const Polygons& polygons_;
  planar::PolygonPlaces places_;
  std::vector<MovingSegment> segments_;
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
    poll_interruption_at(i);
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
  A3D_ASSIGN(auto defect, MovingCheck(moving).defect(monitor));
  if (defect) return defect;
  A3D_ASSIGN(defect, polygon_defect(at(moving, Rational(1, 2)), monitor));
  if (defect) *defect += " in the middle of the unit";
  return defect;
}

}  // namespace algebra3d
