#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace algebra3d {

/// An exact rational number in lowest terms with a positive denominator. A regular value type; a moved-from number is
/// zero. Numerators and denominators that fit 64 bits are stored in place; larger ones are GMP numbers on the heap,
/// counted in `exact_counters().heap_rationals` (copies included). The representation depends only on the value, so
/// equality and hash need no conversion. Zero has denominator 1. Precondition: no division by zero. Cost: a few
/// nanoseconds per operation in place.
class Rational {
 public:
  Rational() = default;
  template <std::integral T>
  Rational(T integer) {  // NOLINT(google-explicit-constructor)
    if (std::in_range<std::int64_t>(integer)) {
      numerator_ = static_cast<std::int64_t>(integer);
    } else {
      *this = from_unsigned(static_cast<std::uint64_t>(integer));
    }
  }
  /// The quotient; `denominator` must not be zero, but may be negative.
  Rational(std::int64_t numerator, std::int64_t denominator);
  /// From a double, which must be finite; exact.
  explicit Rational(double value);
  Rational(const Rational& other)
      : numerator_(other.numerator_),
        denominator_(other.denominator_),
        big_(other.big_ ? copy_of(*other.big_) : nullptr) {}
  Rational(Rational&& other) noexcept
      : numerator_(std::exchange(other.numerator_, 0)),
        denominator_(std::exchange(other.denominator_, 1)),
        big_(std::exchange(other.big_, nullptr)) {}
  Rational& operator=(const Rational& other) {
    if (this != &other) *this = Rational(other);
    return *this;
  }
  Rational& operator=(Rational&& other) noexcept {
    std::swap(numerator_, other.numerator_);
    std::swap(denominator_, other.denominator_);
    std::swap(big_, other.big_);
    if (&other != this) other.reset();
    return *this;
  }
  ~Rational() {
    if (big_ != nullptr) destroy(big_);
  }

  /// Parses a text: `p`, `-p` or `p/q` (decimal digits, q > 0, lowest terms not required) or a decimal number such as
  /// `-1.25e-3`, `.5` or `5.`. Nothing for any other text, also one with a leading `+` or a blank. Any length;
  /// exponents are limited to +-kMaxExponent. Cost: GMP's conversion and one greatest common divisor; some seconds for
  /// ten million digits.
  static std::optional<Rational> parse(std::string_view text);
  static constexpr int kMaxExponent = 10'000;

  /// `p` or `p/q` in lowest terms.
  std::string text() const;
  /// Nearest double, ties to even; infinite beyond the range of doubles.
  double nearest_double() const;
  /// Largest double <= this, smallest double >= this.
  double lower_double() const;
  double upper_double() const;
  /// Nearest double to the square root; ties to even. The number must not be negative.
  double nearest_root() const;
  bool is_double() const;  ///< exactly representable as a finite double
  bool is_dyadic() const;  ///< an integer over a power of two, as every double is
  bool is_integer() const;
  /// True if both terms are stored in place.
  bool is_small() const { return big_ == nullptr; }
  int sign() const { return big_ == nullptr ? (numerator_ > 0) - (numerator_ < 0) : big_sign(); }  ///< -1, 0 or 1
  std::size_t hash() const;
  Rational abs() const { return sign() < 0 ? -*this : *this; }

  Rational operator-() const;
  friend Rational operator+(const Rational& a, const Rational& b);
  friend Rational operator-(const Rational& a, const Rational& b);
  friend Rational operator*(const Rational& a, const Rational& b);
  friend Rational operator/(const Rational& a, const Rational& b);
  Rational& operator+=(const Rational& other) { return *this = *this + other; }
  Rational& operator-=(const Rational& other) { return *this = *this - other; }
  Rational& operator*=(const Rational& other) { return *this = *this * other; }
  Rational& operator/=(const Rational& other) { return *this = *this / other; }

  friend bool operator==(const Rational& a, const Rational& b) {
    if (a.big_ == nullptr && b.big_ == nullptr) {
      return a.numerator_ == b.numerator_ && a.denominator_ == b.denominator_;
    }
    return a.big_ != nullptr && b.big_ != nullptr && equal_big(*a.big_, *b.big_);
  }
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b);

 private:
  struct Big;  // a GMP rational; its definition is known to exact/rational*.cpp only
  friend class RationalAccess;

  static Rational from_unsigned(std::uint64_t integer);
  static Big* copy_of(const Big& other);
  static void destroy(Big* big) noexcept;
  static bool equal_big(const Big& a, const Big& b);
  int big_sign() const;
  void reset() noexcept {
    if (big_ != nullptr) destroy(std::exchange(big_, nullptr));
    numerator_ = 0;
    denominator_ = 1;
  }

  std::int64_t numerator_ = 0;
  std::int64_t denominator_ = 1;
  Big* big_ = nullptr;  // owned; if set, the two integers are unused
};

}  // namespace algebra3d
