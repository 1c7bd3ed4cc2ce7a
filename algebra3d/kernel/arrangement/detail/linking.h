#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/front_winding_ids.h"
#include "algebra3d/kernel/arrangement/detail/subdivision.h"
#include "algebra3d/kernel/arrangement/detail/winding_jumps.h"
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

/// A place at which seeding can find the windings of one of the LinkedWindings::sets: a space edge at which facets
/// meet, and one half-plane there. The set is the one with the front winding of the half-plane.
struct SeedPlace {
  IdRange<SubEdgeId> sub_edges;  ///< all along the space edge
  SubEdgeSide half_plane;        ///< one with a jump
  /// The number of operands with a face there: where each operand is closed alone, only the others need rays.
  std::uint32_t operand_count;
};

/// Output of linking: front windings, known up to one constant for each set.
struct LinkedWindings {
  FrontWindingIds ids;
  WindingSets sets;
  /// One for each set with a jump at a space edge that is on no uncut edge: the first one with the most operands.
  std::vector<SeedPlace> seeds;
};

/// Step 1 of stage 8: unites front windings whose difference is known. The sides of sub-edges
/// round a sub-facet have one front winding (sub_facets.h); round each space edge, the radial order of the half-planes
/// with jumps says how windings change from cell to cell; at uncut edges windings go on into patches. Exact. Errors:
/// internal as number_front_windings. Cost: n log n.
Result<LinkedWindings> link_windings(const Subdivision& subdivision, const WindingJumps& jumps);

/// Every violated invariant, one sentence each: the sets have all front windings, and each side with a jump has one;
/// half-planes with jumps that follow each other round a space edge are in one set, and agree on the cell between them;
/// so do patches at an uncut edge; seeds are at space edges, each with a half-plane of its own that has a jump, and an
/// operand. Cost: n log n, with exact predicates.
std::vector<std::string> audit(const Subdivision& subdivision, const WindingJumps& jumps, const LinkedWindings& linked);

}  // namespace algebra3d::arrangement
