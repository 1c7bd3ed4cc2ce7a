#include "algebra3d/kernel/rounding/detail/simpler_form.h"

#include <algorithm>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/rounding/detail/needle_flips.h"
#include "algebra3d/kernel/rounding/detail/vertex_removal.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// Vertices no farther from the surface than so many spacings are superfluous. With one, a chain of 2000 turned
/// intersections has twice as many triangles as it needs, with two a third more.
constexpr double kSuperfluous = 2;
/// This number on a grid of multiples, which the user asked for and may see: less than the thickness of a plate of one
/// spacing, and more than the 0.87 spacings by which rounding moves a vertex off a plane. With half a spacing a chain
/// of turned intersections has two to three times as many triangles after each step, with 0.9 a fifth more than with
/// one.
constexpr double kSuperfluousOnMultiples = 0.9;
/// How many spacings long the box of the solid must be. On a coarser grid a spacing may be half of a part of the solid.
constexpr double kFineGrid = 256;

/// The longest side of the box around a mesh.
double extent_of(const TriangleMesh& mesh) {
  const Box3 box = Box3::around(mesh.points().approx());
  if (box.is_empty()) return 0;
  const Vec3 size = box.max - box.min;
  return std::max({size.x, size.y, size.z});
}

}  // namespace

double superfluous_within(const TriangleMesh& solid, const CoordinateGrid& grid, double spacing) {
  if (extent_of(solid) < kFineGrid * spacing) return 0;
  return (grid.is_floating() ? kSuperfluous : kSuperfluousOnMultiples) * spacing;
}

Result<bool> make_simpler(TriangleStars& stars, const std::vector<bool>& may_change, double tolerance,
                          const Monitor& monitor) {
  A3D_ASSIGN(const bool is_smaller, remove_superfluous_vertices(stars, may_change, tolerance, monitor));
  const bool is_flipped = flip_needles(stars, may_change, tolerance);
  return is_smaller || is_flipped;
}

}  // namespace algebra3d
