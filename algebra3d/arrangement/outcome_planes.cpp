#include "algebra3d/arrangement/outcome_planes.h"

namespace algebra3d::arrangement {

OutcomePlanes::OutcomePlanes(const Skeleton& skeleton) : skeleton_(skeleton), numbers_(skeleton.operands().count()) {}

std::uint32_t OutcomePlanes::new_number(std::uint32_t operand, std::uint32_t given, bool is_flipped) {
  const FacePlanes& known = skeleton_.operands().mesh(operand).planes();
  auto& numbers = numbers_[operand];
  if (numbers.empty()) numbers.resize(known.size(), {FacePlanes::kUnknown, FacePlanes::kUnknown});
  std::uint32_t& number = numbers[given][is_flipped ? 1 : 0];
  if (number == FacePlanes::kUnknown) number = planes_.add(is_flipped ? known[given].flipped() : known[given]);
  return number;
}

void OutcomePlanes::take(const TakenRun& run) {
  const FacePlanes& known = skeleton_.operands().mesh(run.operand).planes();
  if (known.size() == 0) return;
  for (std::uint32_t i = 0; i < run.count; ++i) {
    const std::uint32_t number = known.number(run.first + i);
    if (number != FacePlanes::kUnknown) planes_.set(run.new_first + i, new_number(run.operand, number, run.is_flipped));
  }
}

void OutcomePlanes::add(std::uint32_t first, std::uint32_t last, std::uint32_t plane, bool is_flipped) {
  const IntegerPlane exact = skeleton_.facets().exact_plane(plane);
  const std::uint32_t number = planes_.add(is_flipped ? exact.flipped() : exact);
  for (std::uint32_t face = first; face < last; ++face) planes_.set(face, number);
}

}  // namespace algebra3d::arrangement
