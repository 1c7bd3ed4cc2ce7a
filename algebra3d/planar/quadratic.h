#pragma once

#include <vector>

#include "algebra3d/exact/rational.h"

namespace algebra3d {

/// The real number `whole + factor * sqrt(radicand)`, exactly; the radicand is not negative, and need be no square.
struct Surd {
  Rational whole;
  Rational factor = 0;
  Rational radicand = 0;

  int sign() const;  ///< -1, 0 or 1
  double approx() const;
};

/// A moment s of a motion over 0 < s < 1, or the time right after it.
struct Moment {
  Surd s;
  bool is_right_after = false;  ///< every s in some (this s, this s + e)
};

/// The polynomial a s^2 + b s + c; a and b may be 0.
struct Quadratic {
  Rational a, b, c;

  bool is_zero() const { return a.sign() == 0 && b.sign() == 0 && c.sign() == 0; }
  Surd at(const Surd& s) const;
  /// Its sign, which right after a moment is that of the first derivative there that is not 0.
  int sign_at(const Moment& moment) const;
  /// Appends the places s with 0 < s < 1 at which it is 0, a double one once; none if it is 0 throughout.
  void append_roots(std::vector<Surd>& roots) const;

  friend Quadratic operator+(const Quadratic& p, const Quadratic& q);
  friend Quadratic operator-(const Quadratic& p, const Quadratic& q);
};

/// A number that changes evenly: `start` at s = 0, `start + change` at s = 1.
struct Linear {
  Rational start, change;

  friend Linear operator-(const Linear& p, const Linear& q);
  friend Quadratic operator*(const Linear& p, const Linear& q);
};

}  // namespace algebra3d
