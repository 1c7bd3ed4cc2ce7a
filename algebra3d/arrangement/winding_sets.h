#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "algebra3d/arrangement/pieces.h"

namespace algebra3d::arrangement {

/// Places whose windings are known relative to each other: disjoint sets with a difference for each member.
/// Cost: logarithmic per call. Source: [tarjan1975] for the sets.
class WindingSets {
 public:
  /// A member's set, and by how much its windings exceed those of the set's name.
  struct Position {
    std::uint32_t set;
    Windings difference;
  };

  explicit WindingSets(std::size_t count) : parent_(count), difference_(count), size_(count, 1) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  Position find(std::uint32_t member) {
    Position position{member, {}};
    while (parent_[position.set] != position.set) {
      position.difference = position.difference + difference_[position.set];
      position.set = parent_[position.set];
    }
    // Everything on the way hangs on the set itself from now on.
    Windings rest = position.difference;
    while (parent_[member] != position.set && member != position.set) {
      const Windings own = std::exchange(difference_[member], rest);
      rest = rest - own;
      member = std::exchange(parent_[member], position.set);
    }
    return position;
  }

  /// The windings of `b` are those of `a` plus `difference`.
  void unite(std::uint32_t a, std::uint32_t b, const Windings& difference) {
    const Position pa = find(a), pb = find(b);
    if (pa.set == pb.set) return;
    // b's set = b - pb = a + difference - pb = (a's set) + pa + difference - pb.
    const Windings step = pa.difference + difference - pb.difference;
    if (size_[pa.set] >= size_[pb.set]) {
      parent_[pb.set] = pa.set;
      difference_[pb.set] = step;
      size_[pa.set] += size_[pb.set];
    } else {
      parent_[pa.set] = pb.set;
      difference_[pa.set] = Windings{} - step;
      size_[pb.set] += size_[pa.set];
    }
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<Windings> difference_;  // to the parent
  std::vector<std::uint32_t> size_;
};

}  // namespace algebra3d::arrangement
