#include "algebra3d/kernel/repair/amount.h"

#include <cmath>

#include <fmt/format.h>

namespace algebra3d {
namespace {

constexpr const char* kBeyondRange = "beyond the range of doubles";

bool is_normal_or_zero(double value, const Rational& exact) {
  return std::isnormal(value) || exact.sign() == 0;
}

}  // namespace

Amount Amount::nearest(Rational exact) {
  constexpr int kStep = 512;
  int exponent = 0;
  while (std::isinf(exact.nearest_double())) {
    exact *= Rational(0x1p-512);
    exponent += kStep;
  }
  while (!is_normal_or_zero(exact.nearest_double(), exact)) {
    exact *= Rational(0x1p512);
    exponent -= kStep;
  }
  return {exact.nearest_double(), exponent};
}

double Amount::ratio_to(const Amount& other) const {
  return std::ldexp(fraction_ / other.fraction_, exponent_ - other.exponent_);
}

std::optional<double> Amount::in_doubles() const {
  const double value = std::ldexp(fraction_, exponent_);
  if (std::isinf(value) || (value == 0 && fraction_ != 0)) return std::nullopt;
  return value;
}

std::string Amount::text(int digits) const {
  const std::optional<double> value = in_doubles();
  return value ? fmt::format("{:.{}g}", *value, digits) : kBeyondRange;
}

std::string length_text(double length, int digits) {
  return std::isfinite(length) ? fmt::format("{:.{}g}", length, digits) : kBeyondRange;
}

}  // namespace algebra3d
