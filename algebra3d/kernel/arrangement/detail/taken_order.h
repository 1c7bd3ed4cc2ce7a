#pragma once

#include <memory>

#include "algebra3d/kernel/arrangement/detail/taken_runs.h"
#include "algebra3d/kernel/halfedge/face_order.h"

namespace algebra3d::arrangement {

/// The order of faces that a result takes over from one operand, in the hierarchy of that operand, if that one gives
/// three quarters of all that are taken over, and if they are not few; else null. It is good for the hierarchy of the
/// result if its frame is the same (FaceOrder), as it mostly is where a small part of a solid changes. Cost: linear.
std::shared_ptr<const FaceOrder> taken_order(const Operands& operands, const TakenRuns& runs);

}  // namespace algebra3d::arrangement
