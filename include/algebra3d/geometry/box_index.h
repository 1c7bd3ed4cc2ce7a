#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"

namespace algebra3d {

/// An R-tree in memory over numbered boxes: finds the boxes that meet a box, the nearest ones, and the pairs that meet.
/// Boxes are closed: touching boxes meet. An empty box meets nothing. Concurrent calls of const members are safe.
class BoxIndex {
 public:
  using Number = std::uint64_t;
  static constexpr std::size_t kMaxBoxes = 0xffffffff;
  struct Neighbour {
    Number number;
    double distance;  ///< Euclidean, from box to box; rounded
  };

  BoxIndex();
  /// Builds the index; the boxes are numbered from 0. Cost: n log n. Nodes are fuller than after insertions. Throws
  /// std::bad_alloc, also for more than kMaxBoxes boxes.
  explicit BoxIndex(std::span<const Box3> boxes);
  ~BoxIndex();
  /// A moved-from index is empty.
  BoxIndex(BoxIndex&& other) noexcept;
  BoxIndex& operator=(BoxIndex&& other) noexcept;

  std::size_t size() const;
  /// Inserts a box; false if it is empty and so is not stored.
  bool insert(const Box3& box, Number number);
  /// Removes one entry with this box and number; false if there is none.
  bool erase(const Box3& box, Number number);

  std::vector<Number> meeting(const Box3& window) const;
  /// At most `limit` entries by ascending distance, then by number.
  std::vector<Neighbour> nearest(const Box3& box, std::size_t limit) const;
  /// Pairs of different entries that meet, each once, the smaller number first.
  std::vector<std::pair<Number, Number>> meeting_pairs() const;
  /// Pairs of an entry of this index and one of the other.
  std::vector<std::pair<Number, Number>> meeting_pairs(const BoxIndex& other) const;

 private:
  struct Tree;
  const Tree& tree() const;

  std::unique_ptr<Tree> tree_;  // null: empty
};

}  // namespace algebra3d
