#pragma once

#include <cstdint>
#include <vector>

#include "base/indices.h"

namespace queries {

/// The buckets of a hash table. The entries are numbered from 0 and stored by the caller.
class HashChains {
 public:
  static constexpr std::uint32_t kNone = algebra3d::kNone;
  /// Estimated bytes per entry: a link, up to two buckets, and the unused capacity of the vectors.
  static constexpr std::size_t kBytesPerEntry = 2 * (2 * sizeof(std::size_t) + 2 * sizeof(std::uint32_t));

  /// Adds the next entry; at most kNone - 1 entries. Cost: constant on average.
  void add(std::size_t hash);
  std::size_t size() const { return links_.size(); }
  bool is_full() const { return links_.size() + 1 == kNone; }
  void clear();

  /// The last entry with this hash, or kNone.
  std::uint32_t last(std::size_t hash) const {
    return buckets_.empty() ? kNone : with_hash(hash, buckets_[bucket_of(hash)]);
  }
  /// The previous entry with the same hash, or kNone.
  std::uint32_t before(std::uint32_t entry) const { return with_hash(links_[entry].hash, links_[entry].before); }

 private:
  struct Link {
    std::size_t hash = 0;
    std::uint32_t before = kNone;  // in the same bucket
  };

  std::size_t bucket_of(std::size_t hash) const { return hash & (buckets_.size() - 1); }
  std::uint32_t with_hash(std::size_t hash, std::uint32_t entry) const {
    while (entry != kNone && links_[entry].hash != hash) entry = links_[entry].before;
    return entry;
  }
  void link(std::size_t entry);

  std::vector<Link> links_;
  std::vector<std::uint32_t> buckets_;  // the last entry of each; their number is a power of two
};

}  // namespace queries
