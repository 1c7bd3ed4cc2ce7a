#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra3d/base/strong_id.h"
#include "base/id_map.h"

namespace algebra3d::detail {

/// Numbers keys of 64 bits from 0 in order of first use.
class KeyNumbers {
 public:
  explicit KeyNumbers(std::size_t expected_count) { numbers_.reserve(expected_count); }

  std::uint32_t operator()(std::uint64_t key) {
    Number& number = numbers_[key];
    if (number.is_none()) {
      number = Number(keys_.size());
      keys_.push_back(key);
    }
    return number.index();
  }
  /// The keys by number.
  const std::vector<std::uint64_t>& keys() const { return keys_; }

 private:
  using Number = StrongId<struct KeyTag>;

  IdMap<Number> numbers_;
  std::vector<std::uint64_t> keys_;
};

}  // namespace algebra3d::detail
