#pragma once

#include <string>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/planar/polygons.h"

namespace algebra3d {

// Well-known text of polygons. Source: [ogc06103], section 7, with PostGIS's prefix `SRID=n;`.

/// Parses `POLYGON ((x y, ...), ...)` or `MULTIPOLYGON (((x y, ...), ...), ...)`; the polygons are not checked for
/// validity. Domain: any bytes. Words in any case, white space between words, numbers and signs; `EMPTY`; `Z`, `M` or
/// `ZM`, also joined to the word before; coordinates after the second are ignored, also without such a mark. Each ring
/// repeats its first point. Exactness: the nearest doubles. Errors: invalid_value, limit_exceeded, with the character
/// (from 1), what was found and what was expected. Cost: linear.
Result<Polygons> polygons_from_wkt(std::string_view text);

/// Writes polygons: `POLYGON` if there is one face, else `MULTIPOLYGON`, with the shortest digits that read back as the
/// same doubles. Exact coordinates are rounded to the nearest doubles.
std::string wkt_of(const Polygons& polygons);

}  // namespace algebra3d
