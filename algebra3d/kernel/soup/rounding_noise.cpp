#include "algebra3d/kernel/soup/rounding_noise.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace algebra3d {
namespace {

bool may_be_float(double x) {
  if (static_cast<double>(static_cast<float>(x)) == x) return true;
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::scientific,
                                 std::numeric_limits<float>::max_digits10 - 1);
  double read = 0;
  std::from_chars(text.data(), end.ptr, read);
  return read == x;
}

}  // namespace

bool RoundingNoise::are_floats() const {
  const auto may_be_floats = [](const Vec3& p) { return may_be_float(p.x) && may_be_float(p.y) && may_be_float(p.z); };
  if (!are_floats_) are_floats_ = std::ranges::all_of(points_, may_be_floats);
  return *are_floats_;
}

double RoundingNoise::within(const Box3& box) const {
  constexpr double kPerDiagonal = 1e-6;
  constexpr double kSpacings = 4;
  if (box.is_empty()) return 0;
  double largest = 0;
  for (const Vec3& corner : {box.min, box.max})
    for (std::size_t axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(corner[axis]));
  const double of_diagonal = kPerDiagonal * length(box.max - box.min);
  const double of_floats = kSpacings * std::numeric_limits<float>::epsilon() * largest;
  if (of_floats <= of_diagonal || are_floats()) return std::max(of_diagonal, of_floats);
  return std::max(of_diagonal, kSpacings * std::numeric_limits<double>::epsilon() * largest);
}

}  // namespace algebra3d
