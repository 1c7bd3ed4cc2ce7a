#include "algebra3d/kernel/planar/detail/quadratic.h"

#include <cmath>
#include <utility>

namespace algebra3d {
namespace {

bool is_within_unit(const Surd& s) {
  return s.sign() > 0 && Surd{s.whole - 1, s.factor, s.radicand}.sign() < 0;
}

void append_if_within_unit(Surd root, std::vector<Surd>& roots) {
  if (is_within_unit(root)) roots.push_back(std::move(root));
}

}  // namespace

int Surd::sign() const {
  const int of_whole = whole.sign();
  const int of_root = radicand.sign() == 0 ? 0 : factor.sign();
  if (of_root == 0 || of_whole == of_root) return of_whole;
  if (of_whole == 0) return of_root;
  // Of different signs: the larger square decides.
  const auto order = whole * whole <=> factor * factor * radicand;
  return order > 0 ? of_whole : order < 0 ? of_root : 0;
}

double Surd::approx() const {
  return whole.nearest_double() + factor.nearest_double() * std::sqrt(radicand.nearest_double());
}

Surd Quadratic::at(const Surd& s) const {
  if (s.factor.sign() == 0 || s.radicand.sign() == 0) return {(a * s.whole + b) * s.whole + c};
  return {a * (s.whole * s.whole + s.factor * s.factor * s.radicand) + b * s.whole + c,
          (2 * a * s.whole + b) * s.factor, s.radicand};
}

int Quadratic::sign_at(const Moment& moment) const {
  const int sign = at(moment.s).sign();
  if (sign != 0 || !moment.is_right_after) return sign;
  const int slope = Quadratic{0, 2 * a, b}.at(moment.s).sign();
  return slope != 0 ? slope : a.sign();
}

void Quadratic::append_roots(std::vector<Surd>& roots) const {
  if (a.sign() == 0) {
    if (b.sign() != 0) append_if_within_unit({-c / b}, roots);
    return;
  }
  const Rational discriminant = b * b - 4 * a * c;
  if (discriminant.sign() < 0) return;
  const Rational half = 1 / (2 * a);
  if (discriminant.sign() == 0) return append_if_within_unit({-b * half}, roots);
  append_if_within_unit({-b * half, half, discriminant}, roots);
  append_if_within_unit({-b * half, -half, discriminant}, roots);
}

Quadratic operator+(const Quadratic& p, const Quadratic& q) {
  return {p.a + q.a, p.b + q.b, p.c + q.c};
}
Quadratic operator-(const Quadratic& p, const Quadratic& q) {
  return {p.a - q.a, p.b - q.b, p.c - q.c};
}

Linear operator-(const Linear& p, const Linear& q) {
  return {p.start - q.start, p.change - q.change};
}
Quadratic operator*(const Linear& p, const Linear& q) {
  return {p.change * q.change, p.start * q.change + p.change * q.start, p.start * q.start};
}

}  // namespace algebra3d
