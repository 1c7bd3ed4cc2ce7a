#pragma once

#include <span>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/distance/distance.h"

namespace algebra3d {

/// A face of one set of triangles, and the known bounds of its distance from another one.
struct BoundedFace {
  FaceId face;
  double at_most;  ///< no point of it is farther
  FaceId near;     ///< a face of the other set that is near, if not nearest
};

/// How far points of these faces of `from` are at most from `to`, or `enough` if that is more: a bound that is much
/// tighter than the given ones where faces moved along the set that they come from. The distance of the farthest point
/// is met within some 2^-57 of the largest coordinate where `to` is nearly flat beside the faces. Rounded arithmetic
/// with guaranteed bounds, in long doubles. Errors: interrupted. Cost: the faces with the largest given bounds are
/// looked at, down to the result; some microseconds for each, and for each face of `to` beside it.
Result<double> bounded_distance(const TriangleMesh& from, std::span<const BoundedFace> faces, const DistanceOperand& to,
                                double enough, const Monitor& monitor = {});
/// Bounds the distance of all faces of `from`, no point of which is farther than `at_most`; the result is at most that,
/// too.
Result<double> bounded_distance(const TriangleMesh& from, double at_most, const DistanceOperand& to, double enough,
                                const Monitor& monitor = {});

}  // namespace algebra3d
