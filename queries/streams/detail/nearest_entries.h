#pragma once

#include <memory>
#include <optional>

#include "queries/streams/spatial_index.h"

namespace queries {

/// The entries of an index by ascending distance from a box, then by id, one by one. If a stored tree turns out to be
/// damaged, they go on from one that is made of the tuples: the order is the same.
class NearestEntries {
 public:
  using Neighbor = rtree::Neighbor<std::uint64_t>;

  NearestEntries(std::shared_ptr<SpatialIndex> index, const algebra3d::Box3& box)
      : index_(std::move(index)), box_(box) {}

  /// The next entry, or nothing at the end. Errors: those of the index.
  Result<std::optional<Neighbor>> next();

 private:
  void search(std::shared_ptr<SpatialIndex::Tree> tree);

  std::shared_ptr<SpatialIndex> index_;
  algebra3d::Box3 box_;
  std::uint64_t count_ = 0;  // of the entries returned
  std::shared_ptr<SpatialIndex::Tree> tree_;
  std::optional<rtree::NearestCursor<std::uint64_t>> cursor_;
};

/// Whether the box of a value is at the distance from another one that an index has given, within rounding.
bool has_box_at(const Value& value, const algebra3d::Box3& from, double distance);

}  // namespace queries
