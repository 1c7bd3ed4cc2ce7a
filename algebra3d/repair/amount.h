#pragma once

#include <optional>
#include <string>

#include "algebra3d/exact/rational.h"

namespace algebra3d {

/// A measured amount of any size, fraction * 2^exponent. Coordinates are doubles; areas and volumes of coordinates that
/// are very large or very small may be beyond what a double can hold.
class Amount {
 public:
  /// Requires a finite fraction.
  Amount(double fraction = 0, int exponent = 0)  // NOLINT(google-explicit-constructor)
      : fraction_(fraction), exponent_(exponent) {}
  /// Rounded.
  static Amount nearest(Rational exact);

  bool is_zero() const { return fraction_ == 0; }
  /// This over the other one, which must not be 0.
  double ratio_to(const Amount& other) const;
  /// The nearest double; none if that is infinite, or 0 while the amount is not.
  std::optional<double> in_doubles() const;
  /// For people, with so many digits; "beyond the range of doubles".
  std::string text(int digits) const;

 private:
  double fraction_;
  int exponent_;
};

/// A length in so many digits; "beyond the range of doubles" if it is infinite.
std::string length_text(double length, int digits);

}  // namespace algebra3d
