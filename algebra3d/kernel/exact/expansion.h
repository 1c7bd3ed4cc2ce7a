#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace algebra3d::detail {

/// Bounds on the coordinates within which sums of products of up to three coordinate differences neither overflow nor
/// lose a bit to underflow: all parts are multiples of 2^(3 * (-200 - 52)) and smaller than 2^(3 * 301 + 3).
inline constexpr double kSmallestSafe = 0x1p-200;
inline constexpr double kLargestSafe = 0x1p300;
inline bool is_safe(double coordinate) {
  const double size = std::abs(coordinate);
  return size == 0 || (size >= kSmallestSafe && size <= kLargestSafe);
}

/// A rounded result and its rounding error: their exact sum is the true result.
struct Rounded {
  double value, rest;
};

inline Rounded two_sum(double a, double b) {
  const double sum = a + b;
  const double from_b = sum - a;
  return {sum, (a - (sum - from_b)) + (b - from_b)};
}

/// Requires |a| >= |b| or a == 0.
inline Rounded fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// `value` as a sum of two numbers of at most 26 bits.
inline Rounded split(double value) {
  const double shifted = 134217729.0 * value;  // 2^27 + 1
  const double high = shifted - (shifted - value);
  return {high, value - high};
}

inline Rounded two_product(double a, double b, const Rounded& b_halves) {
  const double product = a * b;
  const auto [a_high, a_low] = split(a);
  const double missing = ((product - a_high * b_halves.value) - a_low * b_halves.value) - a_high * b_halves.rest;
  return {product, a_low * b_halves.rest - missing};
}

/// An exact number as a sum of at most `Capacity` doubles with non-overlapping bits, in ascending magnitude, without
/// zeros; the empty sum is zero. Exact unless an operation overflows or underflows (see `is_safe`); requires rounding
/// to nearest. Cost: linear in the terms, whatever the capacity. Source: [shewchuk1997], section 2.
template <std::size_t Capacity>
class Expansion {
 public:
  Expansion() {}  // NOLINT(modernize-use-equals-default): this one leaves the terms uninitialised

  std::size_t size() const { return size_; }
  double operator[](std::size_t index) const { return terms_[index]; }
  /// Appends a term of larger magnitude than those before it; zero is left out.
  void append(double term) {
    terms_[size_] = term;
    size_ += term != 0 ? 1 : 0;
  }
  /// The largest term is larger than the sum of all others.
  int sign() const { return size_ == 0 ? 0 : terms_[size_ - 1] > 0 ? 1 : -1; }

 private:
  std::array<double, Capacity + 1> terms_;  // filled up to size_; one more for a zero that append drops
  std::size_t size_ = 0;
};

/// a - b.
inline Expansion<2> difference(double a, double b) {
  const auto [value, rest] = two_sum(a, -b);
  Expansion<2> result;
  result.append(rest);
  result.append(value);
  return result;
}

/// FAST-EXPANSION-SUM of the source: merges by magnitude, then adds from the smallest. `sign` is 1 or -1.
template <std::size_t N, std::size_t M>
Expansion<N + M> add_signed(const Expansion<N>& a, const Expansion<M>& b, double sign) {
  Expansion<N + M> result;
  std::size_t i = 0, j = 0;
  const auto next = [&]() {
    const bool from_a = j == b.size() || (i < a.size() && std::abs(a[i]) < std::abs(b[j]));
    return from_a ? a[i++] : sign * b[j++];
  };
  const std::size_t count = a.size() + b.size();
  double carried = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto [value, rest] = two_sum(carried, next());
    result.append(rest);
    carried = value;
  }
  result.append(carried);
  return result;
}

template <std::size_t N, std::size_t M>
Expansion<N + M> operator+(const Expansion<N>& a, const Expansion<M>& b) {
  return add_signed(a, b, 1);
}
template <std::size_t N, std::size_t M>
Expansion<N + M> operator-(const Expansion<N>& a, const Expansion<M>& b) {
  return add_signed(a, b, -1);
}

/// SCALE-EXPANSION of the source.
template <std::size_t N>
Expansion<2 * N> operator*(const Expansion<N>& a, double factor) {
  Expansion<2 * N> result;
  if (a.size() == 0) return result;
  const Rounded halves = split(factor);
  Rounded carried = two_product(a[0], factor, halves);
  result.append(carried.rest);
  for (std::size_t k = 1; k < a.size(); ++k) {
    const Rounded product = two_product(a[k], factor, halves);
    const Rounded sum = two_sum(carried.value, product.rest);
    result.append(sum.rest);
    carried = fast_two_sum(product.value, sum.value);
    result.append(carried.rest);
  }
  result.append(carried.value);
  return result;
}

/// Product with a difference of two doubles.
template <std::size_t N>
Expansion<4 * N> operator*(const Expansion<N>& a, const Expansion<2>& b) {
  const Expansion<2 * N> nothing;
  return (b.size() > 0 ? a * b[0] : nothing) + (b.size() > 1 ? a * b[1] : nothing);
}

}  // namespace algebra3d::detail
