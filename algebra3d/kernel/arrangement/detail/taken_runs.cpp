#include "algebra3d/kernel/arrangement/detail/taken_runs.h"

#include <algorithm>

#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "base/scheduler.h"

namespace algebra3d::arrangement {
namespace {

/// Runs among the faces of a range; their new faces are not numbered.
std::vector<TakenRun> runs_in(IdRange<InputFaceId> faces, const Operands& operands, const Patches& patches,
                              const KeptPatches& kept) {
  std::vector<TakenRun> runs;
  int before = 0;
  OperandId operand(0);
  InputFaceId operand_end(0);
  for (const InputFaceId face : faces) {
    const int kept_as = kept_of_face(face, patches, kept);
    const bool is_of_next = face >= operand_end;
    if (is_of_next) {
      operand = operands.operand_of(face);
      operand_end = *operands.faces(operand).end();
    }
    if (kept_as != 0 && (kept_as != before || is_of_next))
      runs.push_back({operand, operands.in_mesh(operand, face), {}, 0, kept_as < 0});
    if (kept_as != 0) ++runs.back().count;
    before = kept_as;
  }
  return runs;
}

}  // namespace

TakenRuns::TakenRuns(const Operands& operands, const Patches& patches, const KeptPatches& kept) : operands_(operands) {
  runs_ = parallel_collect(operands.face_count(), kFacesPerTask, [&](std::size_t begin, std::size_t end) {
    return runs_in({InputFaceId(begin), InputFaceId(end)}, operands, patches, kept);
  });
  first_runs_.resize(operands.face_count() / kFacesPerBlock + 1, static_cast<std::uint32_t>(runs_.size()));
  std::size_t block = 0, new_first = 0;
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    TakenRun& run = runs_[i];
    run.new_first = FaceId(new_first);
    new_first += run.count;
    const std::size_t end = operands.input(run.operand, run.first).index() + run.count;
    for (; block * kFacesPerBlock < end; ++block) first_runs_[block] = static_cast<std::uint32_t>(i);
  }
}

const TakenRun* TakenRuns::find(InputFaceId face) const {
  for (std::size_t i = first_runs_[face.index() / kFacesPerBlock]; i < runs_.size(); ++i) {
    const InputFaceId first = operands_.input(runs_[i].operand, runs_[i].first);
    if (first > face) break;
    if (face.index() - first.index() < runs_[i].count) return &runs_[i];
  }
  return nullptr;
}

const TakenRun& TakenRuns::with(FaceId new_face) const {
  return *(std::ranges::upper_bound(runs_, new_face, {}, &TakenRun::new_first) - 1);
}

}  // namespace algebra3d::arrangement
