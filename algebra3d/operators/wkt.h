#pragma once

#include <string>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/planar/polygons.h"

namespace algebra3d {

// Well-known text of polygons. Source: [ogc06103], section 7, and PostGIS's `SRID=n;` before it.

/// The polygons of `POLYGON ((x y, ...), ...)` or `MULTIPOLYGON (((x y, ...), ...), ...)`, of which nothing is proved.
/// Domain: any bytes. Words in any case, white space anywhere between words, numbers and signs; `EMPTY`; `Z`, `M` or
/// `ZM`, also joined to the word before; coordinates after the second are read and ignored, of points without such a
/// mark too. Each ring repeats its first point. Exactness: the nearest doubles. Errors: invalid_value, limit_exceeded;
/// the message says what was found at which character (from 1), and what was expected. Cost: linear.
Result<Polygons> polygons_from_wkt(std::string_view text);

/// `POLYGON` if there is one face, else `MULTIPOLYGON`, with the shortest digits that read back to the same doubles.
/// Coordinates that are no doubles are rounded to the nearest ones.
std::string wkt_of(const Polygons& polygons);

}  // namespace algebra3d
