#include "algebra3d/kernel/exact/point_text.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include <gmpxx.h>

#include "algebra3d/kernel/exact/detail/exact_coordinates.h"
#include "algebra3d/kernel/exact/detail/homogeneous.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

/// Up to so many digits they are read in pieces that fit a limb, which GMP's function for any length is slower than.
constexpr std::size_t kFewDigits = 200;
constexpr std::size_t kDigitsOfPiece = 18;

bool are_digits(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return '0' <= c && c <= '9'; });
}

std::uint64_t small_number(std::string_view digits) {
  std::uint64_t number = 0;
  for (const char digit : digits) number = number * 10 + static_cast<std::uint64_t>(digit - '0');
  return number;
}

void set_digits_of(mpz_ptr number, std::string_view digits) {
  if (digits.size() > kFewDigits) {
    mpz_set_str(number, std::string(digits).c_str(), 10);
    return;
  }
  constexpr std::uint64_t kPiece = 1'000'000'000'000'000'000;
  const std::size_t first = digits.size() % kDigitsOfPiece;
  mpz_set_ui(number, small_number(digits.substr(0, first)));
  for (std::size_t begin = first; begin < digits.size(); begin += kDigitsOfPiece) {
    mpz_mul_ui(number, number, kPiece);
    mpz_add_ui(number, number, small_number(digits.substr(begin, kDigitsOfPiece)));
  }
}

/// False if the text is not a number.
bool set_terms(mpz_class& numerator, mpz_class& denominator, std::string_view text) {
  const bool is_negative = text.starts_with('-');
  if (is_negative) text.remove_prefix(1);
  const std::size_t stroke = text.find('/');
  const std::string_view digits = text.substr(0, stroke);
  const std::string_view divisor = stroke == std::string_view::npos ? "1" : text.substr(stroke + 1);
  if (!are_digits(digits) || !are_digits(divisor)) return false;
  set_digits_of(numerator.get_mpz_t(), digits);
  set_digits_of(denominator.get_mpz_t(), divisor);
  if (is_negative) numerator = -numerator;
  return denominator != 0;
}

}  // namespace

std::optional<ExactPoint> point_of_texts(const std::array<std::string_view, 3>& texts, const Vec3& rounded) {
  thread_local std::array<mpz_class, 3> numerators, denominators;
  thread_local detail::HomogeneousPoint numbers, of_double;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (texts[axis].empty()) {
      of_double.set(Vec3{rounded[axis], 0, 0});
      numerators[axis] = of_double.x;
      denominators[axis] = of_double.w;
    } else if (!set_terms(numerators[axis], denominators[axis], texts[axis])) {
      return std::nullopt;
    }
  }
  numbers.set_fractions({numerators[0].get_mpz_t(), numerators[1].get_mpz_t(), numerators[2].get_mpz_t()},
                        {denominators[0].get_mpz_t(), denominators[1].get_mpz_t(), denominators[2].get_mpz_t()});
  Vec3 approx;
  SharedCoordinates exact = ExactCoordinates::make(numbers, approx);
  if (exact.get() == nullptr || approx != rounded) return std::nullopt;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (texts[axis].empty() != (exact.get()->beyond(axis) == 0)) return std::nullopt;
  return ExactPoint(approx, std::move(exact));
}

}  // namespace algebra3d
