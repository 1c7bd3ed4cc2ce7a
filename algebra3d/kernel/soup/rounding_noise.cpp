#include "algebra3d/kernel/soup/rounding_noise.h"

#include <algorithm>
#include <array>
#include <charconv>
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

bool are_floats(std::span<const Vec3> points) {
  return std::ranges::all_of(points,
                             [](const Vec3& p) { return may_be_float(p.x) && may_be_float(p.y) && may_be_float(p.z); });
}

}  // namespace

double rounding_noise(double diagonal, double largest_coordinate, std::span<const Vec3> points) {
  constexpr double kPerDiagonal = 1e-6;
  constexpr double kSpacings = 4;
  const double of_diagonal = kPerDiagonal * diagonal;
  const double of_floats = kSpacings * std::numeric_limits<float>::epsilon() * largest_coordinate;
  if (of_floats <= of_diagonal || are_floats(points)) return std::max(of_diagonal, of_floats);
  return std::max(of_diagonal, kSpacings * std::numeric_limits<double>::epsilon() * largest_coordinate);
}

}  // namespace algebra3d
