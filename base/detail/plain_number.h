#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "base/text.h"

namespace algebra3d {

/// Number of bytes that must be readable from the beginning of a number for the functions below.
inline constexpr std::ptrdiff_t kPlainNumberBytes = 48;

/// The first eight bytes of a text as decimal digits. Source: [lemire2021], section 3.
class EightDigits {
 public:
  explicit EightDigits(const char* text) {
    static_assert(std::endian::native == std::endian::little, "the first digit is the lowest byte");
    std::memcpy(&digits_, text, sizeof digits_);
    digits_ ^= 0x3030303030303030U;
  }
  /// The number of leading digits, 0 to 8.
  [[nodiscard]] unsigned count() const {
    // A byte below 10 stays below 0x80. Another byte may change those after it, which do not matter then.
    const std::uint64_t others = (digits_ | (digits_ + 0x7676767676767676U)) & 0x8080808080808080U;
    return static_cast<unsigned>(std::countr_zero(others)) / 8;
  }
  /// The value of the first `count` digits, at most 7.
  [[nodiscard]] std::uint64_t front(unsigned count) const { return value(digits_ << (56 - 8 * count) << 8); }
  /// The value of all eight digits.
  [[nodiscard]] std::uint64_t all() const { return value(digits_); }

 private:
  // Combines digits to pairs, pairs to fours, fours to eight.
  static std::uint64_t value(std::uint64_t digits) {
    constexpr std::uint64_t kEveryFourth = 0x000000ff000000ffU;
    const std::uint64_t pairs = digits * 10 + (digits >> 8);
    return ((pairs & kEveryFourth) * 0x000f424000000064U + ((pairs >> 16) & kEveryFourth) * 0x0000271000000001U) >> 32;
  }

  std::uint64_t digits_ = 0;
};

/// Computes the double nearest to significand * 10^exponent; false for the few that need more digits of the power than
/// the table has, and beyond the range of double. Source: [lemire2021], section 5.
bool scaled_double(std::uint64_t significand, int exponent, double& value);

inline constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                          1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
inline constexpr std::uint64_t kIntegerPowersOfTen[] = {1, 10, 100, 1000, 10'000, 100'000, 1'000'000, 10'000'000};

/// Parses the decimal number at `text` on a fast path and returns its end; null if it has 8 or more digits before the
/// point, 20 or more in all, a sign `+`, or no white space after it, or is not a number. Up to 2^53 and down to 10^-22
/// one division is enough, since both operands are exact [clinger1990]. Domain: kPlainNumberBytes bytes are readable.
/// Exactness: the double nearest to the digits. Cost: constant.
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
  if (digit_count - 1 >= 19) [[unlikely]]  // none, or too many for 64 bits
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
  // No branch: signs are unpredictable, and a misprediction costs as much as the rest of a number.
  value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(magnitude) | is_negative << 63);
  return text;
}

}  // namespace algebra3d
