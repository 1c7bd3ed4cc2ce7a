#include "algebra3d/kernel/soup/rounding_noise.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

namespace algebra3d {
namespace {

/// True if the number is a float, or what is read from the text of one with as many digits as the number has.
bool may_be_float(double x) {
  const double nearest = static_cast<float>(x);
  if (nearest == x) return true;
  std::array<char, 32> text{};
  const auto shortest = std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::scientific);
  const std::string_view word(text.data(), shortest.ptr);
  const auto digits =
      std::ranges::count_if(word.substr(0, word.find('e')), [](char c) { return c >= '0' && c <= '9'; });
  if (digits > std::numeric_limits<float>::max_digits10) return false;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), nearest, std::chars_format::scientific,
                                 static_cast<int>(digits) - 1);
  double read = 0;
  std::from_chars(text.data(), end.ptr, read);
  return read == x;
}

/// True if the nearest float has its last bit set: half of all floats have, but no numbers that are multiples of
/// something coarser.
bool uses_last_bit(double x) {
  return (std::bit_cast<std::uint32_t>(static_cast<float>(x)) & 1U) != 0;
}

template <typename Test>
bool any_coordinate(std::span<const Vec3> points, Test test) {
  return std::ranges::any_of(points, [&](const Vec3& p) { return test(p.x) || test(p.y) || test(p.z); });
}

}  // namespace

bool RoundingNoise::are_floats() const {
  if (!are_floats_)
    are_floats_ =
        any_coordinate(points_, uses_last_bit) && !any_coordinate(points_, [](double x) { return !may_be_float(x); });
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
