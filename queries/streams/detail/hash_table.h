#pragma once

#include <cstdint>
#include <vector>

#include "base/indices.h"
#include "base/work_memory.h"
#include "queries/streams/detail/keyed_tuple.h"
#include "queries/streams/mapping.h"

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
  /// Loads the bucket of a hash into the cache, for `bucket`.
  void prefetch_bucket(std::size_t hash) const {
    if (!buckets_.empty()) __builtin_prefetch(&buckets_[bucket_of(hash)]);
  }
  /// The last entry in the bucket of a hash, or kNone. Loads its link into the cache, for `with_hash`.
  std::uint32_t bucket(std::size_t hash) const {
    if (buckets_.empty()) return kNone;
    const std::uint32_t entry = buckets_[bucket_of(hash)];
    if (entry != kNone) __builtin_prefetch(&links_[entry]);
    return entry;
  }
  /// The last entry with this hash from one in its bucket on, or kNone.
  std::uint32_t with_hash(std::size_t hash, std::uint32_t entry) const {
    while (entry != kNone && links_[entry].hash != hash) entry = links_[entry].before;
    return entry;
  }
  /// The previous entry with the same hash, or kNone.
  std::uint32_t before(std::uint32_t entry) const { return with_hash(links_[entry].hash, links_[entry].before); }

 private:
  struct Link {
    std::size_t hash = 0;
    std::uint32_t before = kNone;  // in the same bucket
  };

  std::size_t bucket_of(std::size_t hash) const { return hash & (buckets_.size() - 1); }
  void link(std::size_t entry);

  std::vector<Link> links_;
  std::vector<std::uint32_t> buckets_;  // the last entry of each; their number is a power of two
};

/// A hash table of tuples by the value of one attribute, within the work memory: the table of a BlockJoin. Tuples whose
/// key is undefined are left out; tuples of one key keep their order. Filled first, then searched.
class HashTable {
 public:
  /// `key`: attribute index of the tuples in the table; `probe`: that of the tuples that look them up.
  HashTable(std::size_t key, std::size_t probe, const Context& context)
      : key_({key}), probe_({probe}), account_(context.memory) {}

  /// Adds the tuple; false if the work memory is exhausted. An empty table accepts any tuple. Errors: those of loading.
  Result<bool> add(const TuplePtr& tuple);
  /// Does nothing: a filled hash table is ready for searches.
  void finish() {}
  /// Appends to `found` the tuples whose key equals that of `probe`.
  Status find(const Tuple& probe, std::vector<TuplePtr>& found) const;
  /// All tuples of the table, in the order in which they were added.
  std::vector<TuplePtr> tuples() const;
  void clear();

 private:
  std::vector<std::size_t> key_;
  std::vector<std::size_t> probe_;
  algebra3d::MemoryAccount account_;
  std::vector<KeyedTuple> tuples_;
  HashChains chains_;  // by the key
};

/// A set of value lists that were seen before, within the work memory. Undefined equals undefined.
class SeenKeys {
 public:
  enum class Answer : std::uint8_t { is_new, was_seen, no_room };

  explicit SeenKeys(const Context& context) : account_(context.memory) {}
  /// Adds these loaded values if they are new and memory suffices. An empty set accepts any list. Once the memory is
  /// exhausted nothing is added, so that new lists stay in order.
  Answer add(std::vector<Value> keys);
  void clear();

 private:
  bool is_seen(std::size_t hash, const std::vector<Value>& keys) const;

  algebra3d::MemoryAccount account_;
  std::vector<Value> values_;  // of all lists, concatenated
  HashChains chains_;
  bool is_full_ = false;
};

}  // namespace queries
