#include "algebra3d/kernel/arrangement/detail/classification.h"

#include "algebra3d/kernel/arrangement/detail/linking.h"
#include "algebra3d/kernel/arrangement/detail/propagating.h"
#include "algebra3d/kernel/arrangement/detail/seeding.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"
#include "base/propagate.h"

namespace algebra3d::arrangement {

Result<Classification> classify(const Subdivision& subdivision, const WindingJumps& jumps, Closure closure,
                                const Monitor& monitor) {
  monitor.tell("separating inside from outside");
  A3D_ASSIGN(LinkedWindings linked, link_windings(subdivision, jumps));
  A3D_TRY(check_stage("the linking", [&] { return audit(subdivision, jumps, linked); }));
  A3D_ASSIGN(const SetWindings known, seed_windings(subdivision, jumps, linked, closure, monitor));
  Classification result = propagate_windings(subdivision, linked, known);
  A3D_TRY(check_stage("the classification", [&] { return audit(subdivision, jumps, closure, result); }));
  return result;
}

}  // namespace algebra3d::arrangement
