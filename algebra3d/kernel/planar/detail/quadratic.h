#pragma once

#include <vector>

#include "algebra3d/kernel/exact/rational.h"

namespace algebra3d {

/// The exact real number `whole + factor * sqrt(radicand)`; the radicand is not negative.
struct Surd {
  Rational whole;
  Rational factor = 0;
  Rational radicand = 0;

  int sign() const;  ///< -1, 0 or 1
  double approx() const;
};

/// A time 0 < s < 1 of a motion, or the time right after it.
struct Moment {
  Surd s;
  bool is_right_after = false;  ///< every s in some (this s, this s + e)
};

/// The polynomial a s^2 + b s + c; a and b may be 0.
struct Quadratic {
  Rational a, b, c;

  bool is_zero() const { return a.sign() == 0 && b.sign() == 0 && c.sign() == 0; }
  Surd at(const Surd& s) const;
  /// Its sign; right after a moment that of the first derivative that is not 0.
  int sign_at(const Moment& moment) const;
  /// Appends the roots 0 < s < 1, a double root once; none if the polynomial is 0.
  void append_roots(std::vector<Surd>& roots) const;

  friend Quadratic operator+(const Quadratic& p, const Quadratic& q);
  friend Quadratic operator-(const Quadratic& p, const Quadratic& q);
};

/// A linear function of time: `start` at s = 0, `start + change` at s = 1.
struct Linear {
  Rational start, change;

  friend Linear operator-(const Linear& p, const Linear& q);
  friend Quadratic operator*(const Linear& p, const Linear& q);
};

}  // namespace algebra3d
