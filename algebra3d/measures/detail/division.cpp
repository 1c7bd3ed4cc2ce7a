#include "algebra3d/measures/detail/division.h"

#include <array>
#include <vector>

#include "algebra3d/arrangement/arrangement.h"
#include "algebra3d/measures/detail/bodies.h"

namespace algebra3d {
namespace {

Result<std::size_t> body_count_without(const Volume3d& body, const Volume3d& solid, const Monitor& monitor) {
  const std::array<Operand, 2> operands{{{&body.mesh(), 0, &body.geometry().hierarchy()},
                                         {&solid.mesh(), 1, &solid.geometry().hierarchy()}}};
  const auto is_left = [](const WindingVector& windings) { return windings[0] > 0 && windings[1] == 0; };
  ALGEBRA3D_ASSIGN_OR_RETURN(const TriangleMesh rest, combine_solids(operands, is_left, monitor));
  return body_count(rest, monitor);
}

Result<bool> does_divide(const Volume3d& divider, const Volume3d& solid, const Monitor& monitor) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::vector<Volume3d> bodies, bodies_of(solid, monitor));
  for (const Volume3d& body : bodies) {
    if (!body.box().intersects(divider.box())) continue;
    ALGEBRA3D_ASSIGN_OR_RETURN(const std::size_t count, body_count_without(body, divider, monitor));
    if (count > 1) return true;
  }
  return false;
}

}  // namespace

Result<bool> do_divide(const Volume3d& a, const Volume3d& b, const Monitor& monitor) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_second_divided, does_divide(a, b, monitor));
  if (is_second_divided) return true;
  return does_divide(b, a, monitor);
}

}  // namespace algebra3d
