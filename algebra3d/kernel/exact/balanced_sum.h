#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/rational.h"

namespace algebra3d::detail {

/// A sum of rationals in a balanced tree. Denominators grow with the number of terms, so few of the additions are of
/// large numbers.
class BalancedSum {
 public:
  void add(Rational term) {
    std::size_t level = 0;
    for (; level < partial_.size() && is_used_[level]; ++level) {
      term += partial_[level];
      is_used_[level] = false;
    }
    if (level == partial_.size()) {
      partial_.emplace_back();
      is_used_.push_back(false);
    }
    partial_[level] = std::move(term);
    is_used_[level] = true;
  }
  Rational total() const {
    Rational sum;
    for (std::size_t level = 0; level < partial_.size(); ++level)
      if (is_used_[level]) sum += partial_[level];
    return sum;
  }

 private:
  std::vector<Rational> partial_;  // at level k the sum of 2^k terms
  std::vector<bool> is_used_;
};

}  // namespace algebra3d::detail
