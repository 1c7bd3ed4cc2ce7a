#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/values/display/shape.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d {

/// True for types whose values have a shape: points, vectors, planes, boxes, surfaces, solids, meshes and regions, in
/// space and in the plane, and nested relations with an attribute of such a type. Moving regions have none: a picture
/// of one instant would hide that they move, so the region at an instant is asked for (`atinstant`).
bool is_drawable(const Type& type);

/// The shape of a value of a drawable type (asserted); empty for the undefined and the empty value. A deferred value is
/// loaded.
/// - Triangles of solids, surfaces and meshes have smooth normals; positions are divided at creases of 30 degrees.
/// - The edges of solids and surfaces are those whose faces are not coplanar (decided exactly); of meshes, whose faces
///   are elements by themselves, all of them. With more than a million triangles (or three million half-edges) only
///   edges at which the normals differ by more than 30 degrees. Polygons of a mesh are triangulated; isolated vertices
///   are points.
/// - Of a plane, which has no ends, a square with a frame and half an arrow along the normal is drawn, round the point
///   nearest to the origin, as far to each side as that point is from the origin, at least 1: so it fills a right angle
///   seen from there.
/// - A vector is an arrow from the origin. Values in the plane lie at z = 0, their front up.
/// - Of a nested relation, everything that its tuples have to draw, as one shape.
/// - What is smaller than 2^-100 (8e-31) is a point in the middle of its box.
/// Exactness: coordinates are rounded to doubles, then to floats relative to the origin. Errors: limit_exceeded for
/// boxes beyond the range of floats; interrupted; those of the store. Cost: linear; of meshes and regions see
/// triangulate_faces and triangulate.
Result<DrawnShape> shape_of(const Value& value, const Monitor& monitor = {});

}  // namespace algebra3d
