#include "base/detail/plain_number.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/ascii_cursor.h"

namespace {

using algebra3d::AsciiCursor;
using algebra3d::NumberKind;
using algebra3d::pass_plain_number;

const std::string kRoom(algebra3d::kPlainNumberBytes, ' ');

/// What the standard library reads, or NaN if it does not read all of `text`.
double nearest_double(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return *end == '\0' ? value : std::nan("");
}

/// Bits, so that -0 is not 0.
std::uint64_t bits(double value) {
  return std::bit_cast<std::uint64_t>(value);
}

/// True if the fast way takes `text`; what it gives is the nearest double then, and all of the text is passed.
bool is_plain(const std::string& text) {
  const std::string bytes = text + kRoom;
  double value = 0;
  const char* const behind = pass_plain_number(bytes.data(), value);
  if (behind == nullptr) return false;
  EXPECT_EQ(behind - bytes.data(), static_cast<std::ptrdiff_t>(text.size())) << text;
  EXPECT_EQ(bits(value), bits(nearest_double(text))) << text;
  return true;
}

std::string random_digits(std::mt19937_64& random, unsigned most) {
  std::string digits;
  for (auto count = random() % (most + 1); count > 0; --count) digits += static_cast<char>('0' + random() % 10);
  return digits;
}

TEST(PlainNumber, takes_what_programs_write) {
  for (const char* text : {"0",
                           "-0",
                           "7",
                           "1234567",
                           "0.0",
                           "-0.5",
                           ".5",
                           "5.",
                           "12.345678",
                           "-1.234567e+01",
                           "1.234567E-308",
                           "1e22",
                           "1e-22",
                           "3.4028234663852886e+38",
                           "0.1000000000000000",
                           "9007199254740993.",
                           "1.E+003",
                           "4.9e-324",
                           "1.7976931348623157e308",
                           "0.0012345678901234",
                           "123456.1234567890123",
                           "2.2250738585072014e-308",
                           "0.30000000000000004",
                           "1e-9999",
                           "0e9999"}) {
    const bool has_eight = std::string_view(text).substr(0, 8) == "90071992";
    EXPECT_EQ(is_plain(text), !has_eight) << text;
  }
}

TEST(PlainNumber, leaves_what_takes_longer) {
  for (const char* text : {"",
                           "-",
                           "+1",
                           "--1",
                           ".",
                           "-.",
                           "e5",
                           "1e",
                           "1e+",
                           "1e+-5",
                           "1x",
                           "1.5.2",
                           "0x10",
                           "nan",
                           "inf",
                           "12345678",
                           "0.123456789012345678901",
                           "1,5",
                           "1e400",
                           "1e12345",
                           "1.#QNAN",
                           "1#"})
    EXPECT_FALSE(is_plain(text)) << text;
}

TEST(PlainNumber, random_numbers_are_the_nearest_doubles) {
  std::mt19937_64 random(2021);
  std::size_t plain_count = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    std::string text = random() % 2 == 0 ? "-" : "";
    text += random_digits(random, 8);
    if (random() % 4 != 0) text += "." + random_digits(random, 20);
    if (random() % 2 == 0) text += fmt::format("e{}", static_cast<int>(random() % 700) - 350);
    plain_count += is_plain(text) ? 1 : 0;
  }
  EXPECT_GT(plain_count, 500'000U);
}

// Decimals that lie exactly or nearly in the middle of two doubles are where a rounding goes wrong.
TEST(PlainNumber, decimals_between_two_doubles_are_rounded_right) {
  std::mt19937_64 random(53);
  for (int i = 0; i < 200'000; ++i) {
    const double value = std::ldexp(1 + static_cast<double>(random() % (std::uint64_t{1} << 52)) * 0x1p-52, 0);
    const std::string middle = fmt::format("{:.18f}", value + 0x1p-53);
    for (const std::size_t digits : {15, 16, 17, 18}) is_plain(middle.substr(0, digits + 2));
    is_plain(fmt::format("{}", static_cast<double>(static_cast<float>(value))));
    is_plain(fmt::format("{}", value));
  }
}

TEST(PlainNumber, cursors_read_the_same_near_the_end_of_the_text) {
  for (const std::string text : {"1", "-12.345678", "1.234567e+01", "0.30000000000000004", "12345678.5", "+3"})
    for (std::size_t room = 0; room < kRoom.size(); ++room) {
      const std::string bytes = text + kRoom.substr(0, room);
      AsciiCursor cursor(bytes.data(), bytes.data() + bytes.size());
      double value = 0;
      ASSERT_EQ(cursor.take_number(value), NumberKind::finite) << text;
      EXPECT_EQ(cursor.position() - bytes.data(), static_cast<std::ptrdiff_t>(text.size()));
      EXPECT_EQ(value, nearest_double(text[0] == '+' ? text.substr(1) : text));
    }
}

TEST(EightDigits, counts_and_reads_the_digits_at_the_front) {
  for (int c = 0; c < 256; ++c) {
    const bool is_digit = c >= '0' && c <= '9';
    std::uint64_t number = 0;
    for (unsigned count = 0; count < 8; ++count) {
      std::string text = std::string("12345678").substr(0, count) + static_cast<char>(c) + "99999999";
      const algebra3d::EightDigits digits(text.data());
      EXPECT_EQ(digits.count(), is_digit ? 8 : count) << c;
      EXPECT_EQ(digits.front(count), number);
      number = 10 * number + count + 1;
    }
  }
  EXPECT_EQ(algebra3d::EightDigits("98765432").all(), 98765432U);
}

}  // namespace
