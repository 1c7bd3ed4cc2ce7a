#include "algebra3d/values/types/detail/moving_region_text.h"

#include <utility>

#include "algebra3d/values/types/coordinate_text.h"
#include "algebra3d/values/types/detail/codec_points.h"
#include "algebra3d/values/types/detail/polygons_codec.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {

namespace {

Error unexpected(std::string_view what, std::string_view expectation, const NestedList& found) {
  return {ErrorCode::invalid_value, "{}: expected {}, got {}", what, expectation, found.print_short()};
}

Status add_moving_corner(const NestedList& corner, std::string_view what, MovingPolygons& moving) {
  if (!corner.is_list() || corner.elements().size() != 4) return unexpected(what, "(x1 y1 x2 y2)", corner);
  const auto& parts = corner.elements();
  A3D_ASSIGN(const ExactPoint start, planar_point_from_nested(NestedList::list(parts[0], parts[1]), what));
  A3D_ASSIGN(const ExactPoint end, planar_point_from_nested(NestedList::list(parts[2], parts[3]), what));
  moving.start.corners.push_back(start);
  moving.end.corners.push_back(end);
  return {};
}

Status add_moving_face(const NestedList& face, std::string_view what, MovingPolygons& moving) {
  if (!face.is_list() || face.elements().empty()) return unexpected(what, "a face (outer hole*)", face);
  for (const NestedList& cycle : face.elements()) {
    if (!cycle.is_list() || cycle.elements().size() < 3)
      return unexpected(what, "a cycle of at least 3 moving corners ((x1 y1 x2 y2) ...)", cycle);
    for (const NestedList& corner : cycle.elements()) A3D_TRY(add_moving_corner(corner, what, moving));
    moving.start.cycle_ends.push_back(static_cast<std::uint32_t>(moving.start.corners.size()));
  }
  moving.start.face_ends.push_back(static_cast<std::uint32_t>(moving.start.cycle_ends.size()));
  return {};
}

NestedList moving_corner_to_nested(PointRef start, PointRef end) {
  return NestedList::list(coordinate_to_nested(start.coordinate(0)), coordinate_to_nested(start.coordinate(1)),
                          coordinate_to_nested(end.coordinate(0)), coordinate_to_nested(end.coordinate(1)));
}

}  // namespace

Result<Maybe<RegionUnit>> unit_from_nested(const NestedList& list, std::string_view what, const Monitor& monitor) {
  if (!list.is_list() || list.elements().size() != 2 || !list.elements()[1].is_list() ||
      list.elements()[1].elements().empty())
    return unexpected(what, "(interval (face+))", list);
  A3D_ASSIGN(const Maybe<TimeInterval> interval, interval_from_nested(list.elements()[0], what));
  MovingPolygons moving;
  for (const NestedList& face : list.elements()[1].elements()) A3D_TRY(add_moving_face(face, what, moving));
  moving.end.cycle_ends = moving.start.cycle_ends;
  moving.end.face_ends = moving.start.face_ends;
  if (!interval) return Maybe<RegionUnit>(Undefined{interval.reason()});
  return RegionUnit::prove(*interval, std::move(moving), monitor);
}

NestedList unit_to_nested(const RegionUnit& unit) {
  const auto& [start, end] = unit.polygons();
  NestedList::List faces;
  for (std::size_t f = 0; f < start.face_count(); ++f) {
    poll_interruption_at(f);
    NestedList::List cycles;
    for (std::uint32_t c = start.first_cycle(f); c < start.face_ends[f]; ++c) {
      NestedList::List corners;
      for (std::uint32_t i = start.first_corner(c); i < start.cycle_ends[c]; ++i)
        corners.push_back(moving_corner_to_nested(start.corners[i], end.corners[i]));
      cycles.emplace_back(std::move(corners));
    }
    faces.emplace_back(std::move(cycles));
  }
  return NestedList::list(interval_to_nested(unit.interval()), NestedList(std::move(faces)));
}

void write_unit(ByteWriter& writer, const RegionUnit& unit) {
  write_interval(writer, unit.interval());
  write_polygons(writer, unit.polygons().start);
  write_points(writer, unit.polygons().end.corners);
}

Result<Maybe<RegionUnit>> read_unit(ByteReader& reader, std::string_view what, bool trusted) {
  const Maybe<RegionUnit> none = Undefined{"no unit"};
  const TimeInterval interval = read_interval(reader);
  MovingPolygons moving;
  moving.start = read_polygons(reader);
  moving.end = moving.start;
  moving.end.corners = read_points(reader);
  reader.require(!moving.start.face_ends.empty() && moving.end.corners.size() == moving.start.corners.size(),
                 "a face, and as many corners at the end");
  reader.require(is_in_plane(moving.start.corners) && is_in_plane(moving.end.corners), "corners in the plane");
  if (!reader.ok()) return none;
  if (trusted) return Maybe<RegionUnit>(RegionUnit::trusted(interval, std::move(moving)));
  A3D_ASSIGN(auto unit, RegionUnit::prove(interval, std::move(moving)));
  if (!unit) return Error{ErrorCode::database_corrupt, "{}: {}", what, unit.reason()};
  return unit;
}

}  // namespace algebra3d
