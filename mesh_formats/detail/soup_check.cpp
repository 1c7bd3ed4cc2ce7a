#include "mesh_formats/detail/soup_check.h"

#include <cmath>
#include <limits>

#include "base/float_range.h"
#include "base/propagate.h"

namespace mesh_formats {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::PolygonSoup;
using algebra3d::Status;

namespace {

Status check_points(const PolygonSoup& soup, CoordinateRange range) {
  const bool is_float = range == CoordinateRange::floats;
  const double beyond = is_float ? kBeyondFloat : std::numeric_limits<double>::infinity();
  for (std::size_t point = 0; point < soup.points.size(); ++point)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (const double value = soup.points[point][axis]; !(std::abs(value) < beyond))
        return Error{ErrorCode::invalid_value,
                     "point {}: {} is {}; expected a finite number{}",
                     point + 1,
                     "xyz"[axis],
                     value,
                     is_float ? " within the range of float" : ""};
  return {};
}

Status check_faces(const PolygonSoup& soup) {
  for (std::size_t face = 0; face < soup.face_count(); ++face) {
    const auto corners = soup.face(face);
    if (corners.size() < 3)
      return Error{ErrorCode::invalid_value, "face {} has {} corners; expected at least 3", face + 1, corners.size()};
    for (std::size_t corner = 0; corner < corners.size(); ++corner)
      if (corners[corner] >= soup.points.size())
        return Error{ErrorCode::invalid_value,
                     "face {}, corner {}: the index is {}; expected one of {} points",
                     face + 1,
                     corner + 1,
                     corners[corner],
                     soup.points.size()};
  }
  return {};
}

}  // namespace

Status check_soup(const PolygonSoup& soup, CoordinateRange range) {
  A3D_TRY(check_points(soup, range));
  return check_faces(soup);
}

}  // namespace mesh_formats
