#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/winding_vector.h"
#include "base/id_vector.h"

namespace algebra3d::arrangement {

/// Winding number vectors indexed by ids of one kind: two bytes each while all numbers fit into a byte, as they nearly
/// always do, else eight. All are zero at first.
template <typename Id>
class CompactWindings {
 public:
  CompactWindings() = default;
  explicit CompactWindings(std::size_t size) : narrow_(size) {}

  WindingVector operator[](Id id) const {
    if (!wide_.empty()) return wide_[id.index()];
    const auto& [first, second] = narrow_[id.index()];
    return {first, second};
  }
  void set(Id id, const WindingVector& windings) {
    if (wide_.empty() && !(is_narrow(windings[0]) && is_narrow(windings[1]))) widen();
    if (!wide_.empty())
      wide_[id.index()] = windings;
    else
      narrow_[id.index()] = {static_cast<std::int8_t>(windings[0]), static_cast<std::int8_t>(windings[1])};
  }

  std::size_t size() const { return wide_.empty() ? narrow_.size() : wide_.size(); }
  IdRange<Id> ids() const { return IdRange<Id>(size()); }

 private:
  using Byte = std::numeric_limits<std::int8_t>;

  static bool is_narrow(std::int32_t number) { return number >= Byte::min() && number <= Byte::max(); }
  void widen() {
    wide_.reserve(narrow_.size());
    for (const auto& [first, second] : std::exchange(narrow_, {})) wide_.emplace_back(first, second);
  }

  std::vector<std::array<std::int8_t, WindingVector::kGroupCount>> narrow_;
  std::vector<WindingVector> wide_;  // instead of the others, once a number does not fit
};

}  // namespace algebra3d::arrangement
