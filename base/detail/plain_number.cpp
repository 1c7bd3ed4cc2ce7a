#include "base/detail/plain_number.h"

#include <fast_float/fast_float.h>

namespace algebra3d {

bool scaled_double(std::uint64_t significand, int exponent, double& value) {
  using Double = fast_float::binary_format<double>;
  const fast_float::adjusted_mantissa scaled = fast_float::compute_float<Double>(exponent, significand);
  if (scaled.power2 < 0 || scaled.power2 >= Double::infinite_power()) return false;
  value = std::bit_cast<double>(scaled.mantissa | static_cast<std::uint64_t>(scaled.power2)
                                                      << Double::mantissa_explicit_bits());
  return true;
}

}  // namespace algebra3d
