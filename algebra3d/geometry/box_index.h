#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"

namespace algebra3d {

/// An R-tree in memory over numbered boxes: which of them meet a box, which are nearest, which pairs meet. Closed
/// boxes: touching ones meet. An empty box meets nothing. Constant members may be used by any number of threads.
class BoxIndex {
 public:
  using Number = std::uint64_t;
  struct Neighbour {
    Number number;
    double distance;  ///< Euclidean, from box to box; rounded
  };

  BoxIndex();
  /// The boxes are numbered from 0. Cost: n log n; fuller nodes than those that inserting makes.
  explicit BoxIndex(std::span<const Box3> boxes);
  ~BoxIndex();
  BoxIndex(BoxIndex&& other) noexcept;
  BoxIndex& operator=(BoxIndex&& other) noexcept;

  std::size_t size() const;
  /// False if the box is empty, and so was not stored.
  bool insert(const Box3& box, Number number);
  /// Removes one entry of that box and number; false if there is none.
  bool erase(const Box3& box, Number number);

  std::vector<Number> meeting(const Box3& window) const;
  /// By growing distance, equal distances by number; at most `limit`.
  std::vector<Neighbour> nearest(const Box3& box, std::size_t limit) const;
  /// Pairs of different entries that meet, each once, the smaller number first.
  std::vector<std::pair<Number, Number>> meeting_pairs() const;
  /// Pairs of an entry of this index and one of the other.
  std::vector<std::pair<Number, Number>> meeting_pairs(const BoxIndex& other) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace algebra3d
