#include "algebra3d/kernel/arrangement/detail/classification.h"

#include "algebra3d/kernel/arrangement/detail/linking.h"
#include "algebra3d/kernel/arrangement/detail/propagating.h"
#include "algebra3d/kernel/arrangement/detail/seeding.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"

namespace algebra3d::arrangement {

Result<Classification> classify(const Subdivision& subdivision, const WindingJumps& jumps, Closure closure,
                                const Monitor& monitor) {
  monitor.tell("separating inside from outside");
  ALGEBRA3D_ASSIGN_OR_RETURN(LinkedWindings linked, link_windings(subdivision, jumps));
  ALGEBRA3D_RETURN_IF_ERROR(check_stage("the linking", [&] { return audit(subdivision, jumps, linked); }));
  ALGEBRA3D_ASSIGN_OR_RETURN(const SetWindings known, seed_windings(subdivision, jumps, linked, closure, monitor));
  Classification result = propagate_windings(subdivision, linked, known);
  ALGEBRA3D_RETURN_IF_ERROR(
      check_stage("the classification", [&] { return audit(subdivision, jumps, closure, result); }));
  return result;
}

}  // namespace algebra3d::arrangement
