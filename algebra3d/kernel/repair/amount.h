#pragma once

#include <optional>
#include <string>

#include "algebra3d/kernel/exact/rational.h"

namespace algebra3d {

/// A measured amount of any size: fraction * 2^exponent. The area or volume of very large or very small coordinates may
/// be beyond the range of doubles.
class Amount {
 public:
  /// The fraction is finite.
  Amount(double fraction = 0, int exponent = 0)  // NOLINT(google-explicit-constructor)
      : fraction_(fraction), exponent_(exponent) {}
  /// The exact amount, rounded.
  static Amount nearest(Rational exact);

  bool is_zero() const { return fraction_ == 0; }
  /// The quotient of this amount and another, which must not be 0.
  double ratio_to(const Amount& other) const;
  /// The nearest double; nothing beyond the range of doubles.
  std::optional<double> in_doubles() const;
  /// The amount as text, with `digits` digits, or "beyond the range of doubles".
  std::string text(int digits) const;

 private:
  double fraction_;
  int exponent_;
};

/// A length as text, with `digits` digits, or "beyond the range of doubles" if it is infinite.
std::string length_text(double length, int digits);

}  // namespace algebra3d
