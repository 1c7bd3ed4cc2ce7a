#pragma once

#include <cstddef>
#include <utility>

#include "algebra3d/kernel/arrangement/detail/front_winding_ids.h"
#include "algebra3d/kernel/arrangement/winding_vector.h"
#include "base/id_vector.h"

namespace algebra3d::arrangement {

/// Weighted disjoint sets of front windings: within a set, the difference of any two is known.
/// Cost: logarithmic per call. Source: [tarjan1975] for the sets.
class WindingSets {
 public:
  /// Where a member is: its set, named by one of the set's members, the representative; and the front winding of the
  /// member minus that of the representative.
  struct Position {
    FrontWindingId set;
    WindingVector difference;
  };

  explicit WindingSets(std::size_t count) : parent_(count), difference_(count), size_(count, 1), set_count_(count) {
    for (const FrontWindingId member : parent_.ids()) parent_[member] = member;
  }

  IdRange<FrontWindingId> ids() const { return parent_.ids(); }
  /// Number of the sets.
  std::size_t set_count() const { return set_count_; }

  /// The set of a member and its place there.
  Position find(FrontWindingId member) {
    Position position{member, {}};
    while (parent_[position.set] != position.set) {
      position.difference = position.difference + difference_[position.set];
      position.set = parent_[position.set];
    }
    // Path compression: everything on the way hangs on the representative from now on.
    WindingVector rest = position.difference;
    while (parent_[member] != position.set && member != position.set) {
      const WindingVector own = std::exchange(difference_[member], rest);
      rest = rest - own;
      member = std::exchange(parent_[member], position.set);
    }
    return position;
  }

  /// Unites the sets of two members: `b` is `a` plus `difference`. Without effect if they are in one set already, even
  /// if their difference there is another one.
  void unite(FrontWindingId a, FrontWindingId b, const WindingVector& difference) {
    const Position pa = find(a), pb = find(b);
    if (pa.set == pb.set) return;
    // b's set = b - pb = a + difference - pb = (a's set) + pa + difference - pb.
    const WindingVector excess = pa.difference + difference - pb.difference;
    if (size_[pa.set] >= size_[pb.set])
      hang(pb.set, pa.set, excess);
    else
      hang(pa.set, pb.set, -excess);
  }

 private:
  void hang(FrontWindingId set, FrontWindingId parent, const WindingVector& difference) {
    parent_[set] = parent;
    difference_[set] = difference;
    size_[parent] += size_[set];
    --set_count_;
  }

  IdVector<FrontWindingId, FrontWindingId> parent_;
  IdVector<FrontWindingId, WindingVector> difference_;  // to the parent
  IdVector<FrontWindingId, std::uint32_t> size_;
  std::size_t set_count_;
};

}  // namespace algebra3d::arrangement
