#pragma once

#include <cstddef>
#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/distance/distance.h"

namespace algebra3d {

/// A bound of how far points of `from` are from `to`, in coordinate units. Each triangle of `from` is cut into convex
/// pieces, each of which lies beside one triangle of `to`: distances from a convex set are convex, so no point of a
/// piece is farther from that triangle than its farthest corner. Pieces reach farther beyond the sides of the triangle
/// than they lie from it, by `enough` / 2 at least, so that those of neighbours overlap. So the bound is no more than
/// some four times the distance, or twice `enough`. In contrast to `bounded_distance` that also holds where `to` has
/// needles, folds, and walls that nearly coincide. Nothing if more than `max_pieces` pieces are needed, or if `to` is
/// empty and `from` is not. Rounded arithmetic in long doubles, whose error is in the bound: 2^-58 of the largest
/// coordinate. Deterministic. Errors: interrupted. Cost: a microsecond or two for each piece; these are some times as
/// many as pairs of triangles that lie upon each other.
Result<std::optional<double>> covering_bound(const TriangleMesh& from, const DistanceOperand& to, double enough,
                                             std::size_t max_pieces, const Monitor& monitor = {});

}  // namespace algebra3d
