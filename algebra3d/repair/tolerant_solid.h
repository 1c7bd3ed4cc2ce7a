#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/repair/facet_list.h"
#include "algebra3d/repair/valid_parts.h"

namespace algebra3d {

/// The solid that facets mean which are not quite closed, or not consistently oriented: they are divided at one
/// another, so that they part space into rooms; a room belongs to the solid if the winding number of the facets about
/// points just inside its walls is more than one half on the average, the area counting; what bounds the solid is kept.
/// Walls with the same room on both sides, as beside an open hole, bound nothing.
/// A valid volume, perhaps an empty one. Exactness: all but the winding numbers is exact. Errors: interrupted;
/// limit_exceeded beyond `max_pairs` triangles whose boxes meet, or `max_angles` solid angles.
/// Source: [jacobson2013], with rooms for tetrahedra.
/// `parts` are those of the mesh of the facets.
Result<TriangleMesh> tolerant_solid(const FacetList& facets, const ValidParts& parts, const Monitor& monitor,
                                    const ArrangementOptions& limits, double max_angles);

}  // namespace algebra3d
