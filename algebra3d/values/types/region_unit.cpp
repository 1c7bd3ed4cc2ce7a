#include <algorithm>
#include <mutex>
#include <numeric>
#include <string>

#include "algebra3d/kernel/exact/exact_sum_plane.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/planar/boundary_polygons.h"
#include "algebra3d/kernel/planar/polygon_validity.h"
#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/moving_region.h"
#include "base/propagate.h"

namespace algebra3d {

struct RegionUnit::Content {
  TimeInterval interval;
  MovingPolygons polygons;
  Box3 box;
  mutable std::once_flag once = {};
  mutable MovingPolygons canonical = {};

  Content(const TimeInterval& time, MovingPolygons moving)
      : interval(time), polygons(std::move(moving)), box(unite(box_around(polygons.start), box_around(polygons.end))) {}
};

namespace {

using CornerCycle = std::vector<std::uint32_t>;
using CornerFace = std::vector<CornerCycle>;

std::vector<CornerFace> corner_faces(const Polygons& polygons) {
  std::vector<CornerFace> faces(polygons.face_count());
  for (std::size_t face = 0; face < faces.size(); ++face)
    for (std::uint32_t c = polygons.first_cycle(face); c < polygons.face_ends[face]; ++c) {
      CornerCycle& cycle = faces[face].emplace_back(polygons.cycle_ends[c] - polygons.first_corner(c));
      std::iota(cycle.begin(), cycle.end(), polygons.first_corner(c));
    }
  return faces;
}

/// The polygons with other orders of their corners, cycles and faces.
MovingPolygons rearranged(const MovingPolygons& moving, const std::vector<CornerFace>& faces) {
  MovingPolygons result;
  for (const CornerFace& face : faces) {
    for (const CornerCycle& cycle : face) {
      for (const std::uint32_t corner : cycle) {
        result.start.corners.push_back(moving.start.corners[corner]);
        result.end.corners.push_back(moving.end.corners[corner]);
      }
      result.start.cycle_ends.push_back(static_cast<std::uint32_t>(result.start.corners.size()));
    }
    result.start.face_ends.push_back(static_cast<std::uint32_t>(result.start.cycle_ends.size()));
  }
  result.end.cycle_ends = result.start.cycle_ends;
  result.end.face_ends = result.start.face_ends;
  return result;
}

/// Outer cycles counter-clockwise, holes clockwise; the sense of rotation is the same at all times between the ends.
MovingPolygons oriented_motion(const MovingPolygons& moving) {
  const Polygons middle = at(moving, Rational(1, 2));
  std::vector<CornerFace> faces = corner_faces(middle);
  bool is_changed = false;
  for (CornerFace& face : faces)
    for (CornerCycle& cycle : face) {
      const int turn = exact_doubled_area(middle.corners, cycle.front(), cycle.back() + std::size_t{1}).sign();
      if (turn == (&cycle == &face.front() ? 1 : -1)) continue;
      std::reverse(cycle.begin() + 1, cycle.end());
      is_changed = true;
    }
  return is_changed ? rearranged(moving, faces) : moving;
}

MovingPolygons canonical_motion(const MovingPolygons& moving) {
  const auto comes_before = [&](std::uint32_t i, std::uint32_t j) {
    const auto order = compare(moving.start.corners[i], moving.start.corners[j]);
    return std::is_neq(order) ? order < 0 : compare(moving.end.corners[i], moving.end.corners[j]) < 0;
  };
  const auto cycle_before = [&](const CornerCycle& a, const CornerCycle& b) {
    return std::ranges::lexicographical_compare(a, b, comes_before);
  };
  std::vector<CornerFace> faces = corner_faces(moving.start);
  for (CornerFace& face : faces) {
    for (CornerCycle& cycle : face)
      std::rotate(cycle.begin(), std::ranges::min_element(cycle, comes_before), cycle.end());
    std::sort(face.begin() + 1, face.end(), cycle_before);
  }
  std::ranges::sort(faces, [&](const CornerFace& a, const CornerFace& b) {
    return std::ranges::lexicographical_compare(a, b, cycle_before);
  });
  return rearranged(moving, faces);
}

Result<std::optional<std::string>> defect_of_unit(const TimeInterval& interval, const MovingPolygons& polygons,
                                                  const Monitor& monitor) {
  if (interval.start != interval.end) return moving_polygon_defect(polygons, monitor);
  if (!(polygons.start == polygons.end)) return std::optional<std::string>("the corners move within a single instant");
  return polygon_defect(polygons.start, monitor);
}

/// A region of polygons that bound one once the segments that lie on each other are left out.
Result<Region> regularised(const Polygons& polygons, const Monitor& monitor) {
  A3D_ASSIGN(auto given, Region::prove(polygons, monitor));
  if (given) return *std::move(given);
  A3D_ASSIGN(Polygons boundary, boundary_polygons(polygons, monitor));
  return Region::trusted(std::move(boundary));
}

}  // namespace

Result<Maybe<RegionUnit>> RegionUnit::prove(const TimeInterval& interval, const MovingPolygons& polygons,
                                            const Monitor& monitor) {
  A3D_ASSIGN(auto defect, defect_of_unit(interval, polygons, monitor));
  if (defect) return Maybe<RegionUnit>(Undefined{*std::move(defect)});
  return Maybe<RegionUnit>(trusted(interval, oriented_motion(polygons)));
}

RegionUnit RegionUnit::trusted(const TimeInterval& interval, MovingPolygons polygons) {
  return RegionUnit(std::make_shared<const Content>(interval, std::move(polygons)));
}

const TimeInterval& RegionUnit::interval() const {
  return content_->interval;
}
const MovingPolygons& RegionUnit::polygons() const {
  return content_->polygons;
}
const Box3& RegionUnit::box() const {
  return content_->box;
}

const MovingPolygons& RegionUnit::canonical() const {
  std::call_once(content_->once, [&] { content_->canonical = canonical_motion(content_->polygons); });
  return content_->canonical;
}

std::size_t RegionUnit::heap_bytes() const {
  return object_bytes<Content>() + polygons().start.heap_bytes() + polygons().end.heap_bytes();
}

Result<Region> RegionUnit::at(Instant instant, const Monitor& monitor) const {
  const TimeInterval& time = interval();
  if (instant == time.start) return regularised(polygons().start, monitor);
  if (instant == time.end) return regularised(polygons().end, monitor);
  const Rational s(instant.milliseconds - time.start.milliseconds, time.end.milliseconds - time.start.milliseconds);
  return Region::trusted(algebra3d::at(polygons(), s));
}

std::strong_ordering operator<=>(const RegionUnit& a, const RegionUnit& b) {
  if (const auto order = a.interval() <=> b.interval(); std::is_neq(order)) return order;
  const MovingPolygons& p = a.canonical();
  const MovingPolygons& q = b.canonical();
  const auto order = p.start <=> q.start;
  return std::is_neq(order) ? order : p.end <=> q.end;
}

std::size_t RegionUnit::hash() const {
  std::size_t result = hash_of(interval());
  for (const PointArray* points : {&canonical().start.corners, &canonical().end.corners})
    for (std::size_t i = 0; i < points->size(); ++i) result = combine_hashes(result, points->point(i).hash());
  return result;
}

}  // namespace algebra3d
