#include "algebra3d/kernel/arrangement/detail/result_planes.h"

#include <algorithm>

namespace algebra3d::arrangement {

void ResultPlanes::take(const TakenRun& run) {
  const FacePlanes& known = subdivision_.operands.mesh(run.operand).planes();
  if (known.size() == 0) return;
  NewNumbers& new_numbers = numbers_[run.operand][run.is_flipped ? 1 : 0];
  if (new_numbers.empty()) new_numbers.resize(known.size(), FacePlanes::kUnknown);
  const std::span<std::uint32_t> taken = planes_.numbers(run.new_first.index(), run.count);
  for (std::size_t i = 0; i < run.count; ++i) {
    const std::uint32_t given = known.number(run.first.index() + i);
    if (given == FacePlanes::kUnknown) continue;
    std::uint32_t& number = new_numbers[given];
    if (number == FacePlanes::kUnknown) number = planes_.add(run.is_flipped ? known[given].flipped() : known[given]);
    taken[i] = number;
  }
}

void ResultPlanes::add(IdRange<FaceId> faces, PlaneId plane, bool is_flipped) {
  const IntegerPlane exact = subdivision_.complex.coefficients.find_or_compute(subdivision_.facets, plane);
  const std::uint32_t number = planes_.add(is_flipped ? exact.flipped() : exact);
  std::ranges::fill(planes_.numbers(faces.front().index(), faces.size()), number);
}

}  // namespace algebra3d::arrangement
