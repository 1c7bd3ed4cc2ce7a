#include "algebra3d/kernel/arrangement/detail/taken_order.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "base/scheduler.h"

namespace algebra3d::arrangement {
namespace {

/// Fewer are sorted as soon.
constexpr std::size_t kFewFaces = 512;

/// The operand that gives three quarters of the faces; else none.
OperandId main_operand(const Operands& operands, const TakenRuns& runs) {
  IdVector<OperandId, std::size_t> counts(operands.count());
  for (const TakenRun& run : runs) counts[run.operand] += run.count;
  for (const OperandId operand : counts.ids())
    if (counts[operand] >= kFewFaces && 4 * counts[operand] >= 3 * runs.face_count()) return operand;
  return {};
}

/// The new face of each face of the operand; none where it is not taken over.
std::vector<FaceId> new_faces(const Operands& operands, const TakenRuns& runs, OperandId operand) {
  std::vector<FaceId> result(operands.mesh(operand).face_count());
  for (const TakenRun& run : runs)
    if (run.operand == operand)
      for (std::size_t i = 0; i < run.count; ++i) result[run.first.index() + i] = FaceId(run.new_first.index() + i);
  return result;
}

}  // namespace

std::shared_ptr<const FaceOrder> taken_order(const Operands& operands, const TakenRuns& runs) {
  const OperandId operand = main_operand(operands, runs);
  if (operand.is_none()) return nullptr;
  const BoxHierarchy& hierarchy = operands.hierarchy(operand);
  const std::vector<FaceId> new_face_of = new_faces(operands, runs, operand);
  auto order = std::make_shared<FaceOrder>();
  order->frame = hierarchy.frame();
  order->faces = parallel_collect(hierarchy.face_count(), kFacesPerTask, [&](std::size_t begin, std::size_t end) {
    std::vector<PlacedFace> taken(end - begin);
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const PlacedFace placed = hierarchy.placed(i);
      const FaceId face = new_face_of[placed.face()];
      taken[count] = PlacedFace(placed.place(), face.index());
      count += face.is_valid() ? 1 : 0;
    }
    taken.resize(count);
    return taken;
  });
  return order;
}

}  // namespace algebra3d::arrangement
