#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "stl/text.h"

namespace stl {

/// How many bytes must be readable from where a number is taken by the functions below.
inline constexpr std::ptrdiff_t kPlainNumberRoom = 48;

/// The first eight bytes of a text as decimal digits. Source: [lemire2021], section 3.
class EightDigits {
 public:
  explicit EightDigits(const char* text) {
    static_assert(std::endian::native == std::endian::little, "the first digit is the lowest byte");
    std::memcpy(&digits_, text, sizeof digits_);
    digits_ ^= 0x3030303030303030U;
  }
  /// How many digits stand at the front, 0 to 8.
  [[nodiscard]] unsigned count() const {
    // A byte below 10 stays below 0x80. One that is no digit may change those behind it, which do not count any more.
    const std::uint64_t others = (digits_ | (digits_ + 0x7676767676767676U)) & 0x8080808080808080U;
    return static_cast<unsigned>(std::countr_zero(others)) / 8;
  }
  /// The number that the first `count` digits are, at most 7.
  [[nodiscard]] std::uint64_t front(unsigned count) const { return value(digits_ << (56 - 8 * count) << 8); }
  /// The number that all eight are.
  [[nodiscard]] std::uint64_t all() const { return value(digits_); }

 private:
  // Pairs of digits, then pairs of those, then pairs of those.
  static std::uint64_t value(std::uint64_t digits) {
    constexpr std::uint64_t kEveryFourth = 0x000000ff000000ffU;
    const std::uint64_t pairs = digits * 10 + (digits >> 8);
    return ((pairs & kEveryFourth) * 0x000f424000000064U + ((pairs >> 16) & kEveryFourth) * 0x0000271000000001U) >> 32;
  }

  std::uint64_t digits_ = 0;
};

/// The double nearest to `significand` times ten to the `exponent`; false for the few that need more digits of the
/// power than are kept, and for those beyond the range of double. Source: [lemire2021], section 5.
bool scaled_double(std::uint64_t significand, int exponent, double& value);

inline constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                          1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
inline constexpr std::uint64_t kIntegerPowersOfTen[] = {1, 10, 100, 1000, 10'000, 100'000, 1'000'000, 10'000'000};

/// Where the decimal number at `text` ends, which has its value then; or null, if it is one that takes longer: of 8
/// digits or more before the point, of 20 or more in all, with a sign `+`, not followed by white space, or none at all.
/// Up to 2^53 and down to 10^-22 one division gives it, since both numbers are exact [clinger1990].
/// Domain: kPlainNumberRoom bytes are readable. Exactness: the double nearest to the digits. Cost: constant.
[[gnu::always_inline]] inline const char* pass_plain_number(const char* text, double& value) {
  const std::uint64_t is_negative = *text == '-' ? 1 : 0;
  text += is_negative;
  const EightDigits whole(text);
  const unsigned whole_count = whole.count();
  if (whole_count == 8) [[unlikely]]
    return nullptr;
  std::uint64_t significand = whole.front(whole_count);
  unsigned fraction_count = 0;
  text += whole_count;
  if (*text == '.') [[likely]] {
    ++text;
    EightDigits fraction(text);
    unsigned count = fraction.count();
    while (count == 8) {
      significand = significand * 100'000'000 + fraction.all();
      fraction_count += 8;
      text += 8;
      if (fraction_count > 16) return nullptr;
      fraction = EightDigits(text);
      count = fraction.count();
    }
    significand = significand * kIntegerPowersOfTen[count] + fraction.front(count);
    fraction_count += count;
    text += count;
  }
  const unsigned digit_count = whole_count + fraction_count;
  if (digit_count - 1 >= 19) [[unlikely]]  // none, or perhaps more than 64 bits hold
    return nullptr;
  int exponent = -static_cast<int>(fraction_count);
  if ((*text | 0x20) == 'e') {
    const bool is_downward = text[1] == '-';
    text += is_downward || text[1] == '+' ? 2 : 1;
    const EightDigits digits(text);
    const unsigned count = digits.count();
    if (count == 0 || count > 4) [[unlikely]]
      return nullptr;
    const int written = static_cast<int>(digits.front(count));
    exponent += is_downward ? -written : written;
    text += count;
  }
  if (!is_blank(*text)) [[unlikely]]
    return nullptr;
  double magnitude = 0;
  if (significand <= std::uint64_t{1} << 53 && exponent <= 0 && exponent >= -22) [[likely]]
    magnitude = static_cast<double>(static_cast<std::int64_t>(significand)) / kPowersOfTen[-exponent];
  else if (!scaled_double(significand, exponent, magnitude)) [[unlikely]]
    return nullptr;
  // No branch: signs are as good as random, and a wrong guess takes as long as the rest of a number.
  value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(magnitude) | is_negative << 63);
  return text;
}

}  // namespace stl
