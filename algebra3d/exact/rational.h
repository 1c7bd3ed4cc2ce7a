#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace algebra3d {

/// Exact rational number in lowest terms, denominator positive. A regular value type.
/// Numerators and denominators that fit 64 bits are held in place; larger ones are GMP numbers on the heap, counted in
/// `exact_counters().heap_rationals`. Zero has denominator 1. Errors: division by zero is a mistake of the caller.
class Rational {
 public:
  Rational() = default;
  Rational(std::int64_t integer);  // NOLINT(google-explicit-constructor)
  Rational(std::int64_t numerator, std::int64_t denominator);
  /// Exactly `value`, which must be finite.
  explicit Rational(double value);
  Rational(const Rational& other);
  Rational(Rational&& other) noexcept;
  Rational& operator=(const Rational& other);
  Rational& operator=(Rational&& other) noexcept;
  ~Rational();

  /// Reads `p`, `-p` or `p/q` (decimal digits, q > 0, lowest terms not required) or a decimal number such as
  /// `-1.25e-3`; all of `text`. Nothing on any other text. Length is limited to kMaxDigits, exponents to
  /// +-kMaxExponent.
  static std::optional<Rational> parse(std::string_view text);
  static constexpr std::size_t kMaxDigits = 100'000;
  static constexpr int kMaxExponent = 10'000;

  /// `p` or `p/q` in lowest terms.
  std::string text() const;
  /// Nearest double, ties to even; infinite beyond the range of doubles.
  double nearest_double() const;
  /// Largest double <= this, smallest double >= this.
  double lower_double() const;
  double upper_double() const;
  bool is_double() const;  ///< exactly representable as a finite double
  int sign() const;        ///< -1, 0 or 1
  std::size_t hash() const;

  Rational operator-() const;
  friend Rational operator+(const Rational& a, const Rational& b);
  friend Rational operator-(const Rational& a, const Rational& b);
  friend Rational operator*(const Rational& a, const Rational& b);
  friend Rational operator/(const Rational& a, const Rational& b);
  Rational& operator+=(const Rational& other) { return *this = *this + other; }
  Rational& operator-=(const Rational& other) { return *this = *this - other; }
  Rational& operator*=(const Rational& other) { return *this = *this * other; }

  friend bool operator==(const Rational& a, const Rational& b);
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b);

 private:
  struct Big;  // a GMP rational; only exact/rational.cpp knows its inside
  std::int64_t numerator_ = 0;
  std::int64_t denominator_ = 1;
  Big* big_ = nullptr;  // owned; if set, the two integers mean nothing
};

}  // namespace algebra3d
