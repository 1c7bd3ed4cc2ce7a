#include "algebra3d/arrangement/detail/result_planes.h"

namespace algebra3d::arrangement {

std::uint32_t ResultPlanes::new_number(OperandId operand, std::uint32_t given, bool is_flipped) {
  const FacePlanes& known = subdivision_.operands.mesh(operand).planes();
  std::vector<NewNumbers>& numbers = numbers_[operand];
  if (numbers.empty()) numbers.resize(known.size());
  std::uint32_t& number = is_flipped ? numbers[given].flipped : numbers[given].plain;
  if (number == FacePlanes::kUnknown) number = planes_.add(is_flipped ? known[given].flipped() : known[given]);
  return number;
}

void ResultPlanes::take(const TakenRun& run) {
  const FacePlanes& known = subdivision_.operands.mesh(run.operand).planes();
  if (known.size() == 0) return;
  for (std::size_t i = 0; i < run.count; ++i) {
    const std::uint32_t number = known.number(run.first.index() + i);
    if (number != FacePlanes::kUnknown)
      planes_.set(run.new_first.index() + i, new_number(run.operand, number, run.is_flipped));
  }
}

void ResultPlanes::add(IdRange<FaceId> faces, PlaneId plane, bool is_flipped) {
  const IntegerPlane exact = subdivision_.complex.coefficients.find_or_compute(subdivision_.facets, plane);
  const std::uint32_t number = planes_.add(is_flipped ? exact.flipped() : exact);
  for (const FaceId face : faces) planes_.set(face.index(), number);
}

}  // namespace algebra3d::arrangement
