#pragma once

#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/search/box_hierarchy.h"

namespace algebra3d {

/// A solid with the hierarchy over all its faces. Both must outlive the question.
struct CongruenceOperand {
  const TriangleMesh* mesh = nullptr;
  const BoxHierarchy* hierarchy = nullptr;
};

/// A motion of a solid: first, if it is mirrored, the reflection at `centre` (x -> 2 centre - x), then the rotation
/// about the line through `centre` along `axis`, then the translation.
struct RigidMotion {
  Vec3 centre;               ///< the centre of mass of the first solid
  Vec3 axis;                 ///< a unit vector
  double angle_degrees = 0;  ///< 0 to 180, right-handed
  Vec3 translation;          ///< between the centres of mass
  bool is_mirrored = false;
};

/// A motion that carries the first solid onto the second: after it, no point of either boundary is farther than
/// `tolerance` from the other one (the Hausdorff distance of the boundaries). So triangulations do not matter. Nothing
/// if none is found. Proper motions before mirrored ones, then small angles before large ones.
///
/// A motion is checked on all of both boundaries, with doubles, before it is given. A tolerance below 2^-36 of the size
/// of the solids, or below 2^-48 of their coordinates, is raised to that. Which motions are tried: those that map the
/// centres of mass to each other, and principal axes to principal axes, or, where moments are equal or nearly so,
/// vertices to vertices. So copies are found that were moved and rounded; of solids that are alike only within a coarse
/// tolerance, a motion may be missed. Errors: interrupted. Cost: linear for copies, some microseconds for each
/// triangle; that of the pairs of triangles that are near each other where triangulations differ. Wrong motions fail
/// soon.
Result<std::optional<RigidMotion>> find_congruence(const CongruenceOperand& first, const CongruenceOperand& second,
                                                   double tolerance, const Monitor& monitor = {});

}  // namespace algebra3d
