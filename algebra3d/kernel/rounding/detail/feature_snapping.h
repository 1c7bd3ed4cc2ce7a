#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/rounding/detail/snapped_faces.h"

namespace algebra3d {

/// The result of feature snapping: no mesh if that was given up.
struct FeatureSnappedMesh {
  std::optional<TriangleMesh> mesh = {};
  double largest_displacement = 0;   ///< no corner is farther from the point of the given mesh that it stands for
  double largest_distance = 0;       ///< no point of the mesh is farther from the given one
  double reach = 0;                  ///< the largest one within which features were joined; 0 if nothing crossed
  std::size_t crossings_before = 0;  ///< pairs of faces that crossed
  std::size_t crossing_pairs = 0;    ///< 0 if no faces cross any more; else an upper bound of their pairs
  std::size_t work = 0;  ///< faces searched for crossings and pairs found, of all rounds but the first search
};

/// The limits of feature snapping.
struct SnappingLimits {
  double largest_reach = 0;               ///< in spacings
  std::size_t most_crossings = SIZE_MAX;  ///< a mesh with more crossings is given up
  std::size_t most_work = SIZE_MAX;       ///< a mesh that takes more work (FeatureSnappedMesh::work) is given up
};

/// Feature snapping: joins features of crossing faces of a mesh (near_features.h) in rounds, until no faces cross. The
/// reach is two spacings at first. A cluster (snapped_faces.h) that goes on crossing is restored, and begins again with
/// twice the reach, and new vertices on a grid twice as coarse, as long as the reach is at most the largest one. What
/// has too many crossings, or gets more and more of them, is given up. A closed mesh stays closed. Vertices of the
/// result are given ones or lie on the grid; it may have edges with more than two faces, and places with other winding
/// numbers than 0 and 1. Domain: all coordinates are doubles. Exactness: crossings are decided exactly, nearness
/// is not. Deterministic. Errors: interrupted. Cost: that of finding all crossings, and some ten
/// microseconds for each unit of work.
Result<FeatureSnappedMesh> snap_features(const TriangleMesh& mesh, const CoordinateGrid& grid, double spacing,
                                         const SnappingLimits& limits, const std::atomic<bool>* cancel,
                                         Folded folded = Folded::vanishes);

}  // namespace algebra3d
