#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "algebra3d/kernel/exact/rational.h"

namespace algebra3d {

/// The exact sum of any number of finite doubles, independent of their order: a fixed-point number that spans the range
/// of doubles, with 64 more bits at the top. Cost: constant per summand, 0.6 kB. Source: [neal2015], the small
/// superaccumulator.
class RealSum {
 public:
  /// Adds a finite value.
  void add(double value);
  /// Adds another sum.
  void add(const RealSum& other);
  /// The sum; 0 if nothing was added.
  Rational total() const;
  std::uint64_t count() const { return count_; }  ///< of summands

 private:
  void carry();

  // Digit i counts multiples of 2^(32 i - 1074); between two carries it may exceed 32 bits in magnitude.
  static constexpr std::size_t kDigits = 69;
  std::array<std::int64_t, kDigits> digits_{};
  std::uint64_t count_ = 0;
};

}  // namespace algebra3d
