#pragma once

#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/rational.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/search/box_hierarchy.h"

namespace algebra3d {

// Distances of sets that are given by triangles: surfaces, and boundaries of solids. The inside of a solid does not
// count here. A face of a mesh that repeats a corner stands for a segment or a point.

/// A set of triangles with the hierarchy over all of them. Refers to both.
struct DistanceOperand {
  const TriangleMesh* mesh;
  const BoxHierarchy* hierarchy;
};

/// The points of two sets that are nearest to each other, the square of their distance, and the faces that they are in.
struct ClosestPoints {
  ExactPoint first, second;
  Rational squared_distance;
  FaceId first_face, second_face;
};

/// The nearest points; if several pairs are equally near, always the same one of them; nothing if a set is empty.
/// Exact: rounded arithmetic with bounds leaves few pairs of faces, of which rationals choose. Errors: interrupted.
/// Cost: that of the pairs of boxes that are nearer to each other than the sets and that the slab across the direction
/// of the nearest points does not keep apart; some milliseconds for meshes of a million faces that are not parallel to
/// each other over large parts. Source: [larsen2000] for the search in two hierarchies.
Result<std::optional<ClosestPoints>> closest_points(const DistanceOperand& a, const DistanceOperand& b,
                                                    const Monitor& monitor = {});

/// The square of the distance alone. Exact. Errors, cost: as closest_points, without the points.
Result<std::optional<Rational>> squared_distance(const DistanceOperand& a, const DistanceOperand& b,
                                                 const Monitor& monitor = {});

/// Two doubles between which a distance lies.
struct DistanceRange {
  double lower = 0, upper = 0;
};

/// Bounds of the distance, in coordinate units: the upper one is infinite beyond the range of doubles. Nothing if a set
/// is empty, or if they are certainly farther apart than `reach`. Rounded arithmetic only: both are within some hundred
/// roundings of the distance. Errors: interrupted. Cost: a small part of that of closest_points.
Result<std::optional<DistanceRange>> distance_range(const DistanceOperand& a, const DistanceOperand& b, double reach,
                                                    const Monitor& monitor = {});

/// True if a point of one set is at most so far from one of the other; false if a set is empty. `distance` must not be
/// negative. Exact. Errors: interrupted. Cost: as closest_points, and less where faces are clearly nearer.
Result<bool> are_within(const DistanceOperand& a, const DistanceOperand& b, const Rational& distance,
                        const Monitor& monitor = {});

}  // namespace algebra3d
