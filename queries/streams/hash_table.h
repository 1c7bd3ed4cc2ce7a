#pragma once

#include <vector>

#include "algebra3d/base/work_memory.h"
#include "queries/streams/keyed_tuple.h"
#include "queries/streams/mapping.h"

namespace queries {

/// Tuples by the value of one attribute, as many as the work memory takes. Tuples whose key is undefined are left out;
/// those of one key keep the order in which they came. First filled, then asked. A part of a PartwiseJoin.
class HashTable {
 public:
  /// `key` of the tuples that are held, `probe` of those that ask.
  HashTable(std::size_t key, std::size_t probe, const Context& context)
      : key_({key}), probe_({probe}), account_(context.memory) {}

  /// Keeps the tuple; false if there is no room for it. An empty table takes any tuple. Errors: those of loading.
  Result<bool> add(const TuplePtr& tuple);
  /// Makes it ready to be asked.
  void finish();
  /// Appends the tuples whose key equals the one of `probe`.
  Status find(const Tuple& probe, std::vector<TuplePtr>& found) const;
  /// All that it holds, in the order in which they came.
  std::vector<TuplePtr> tuples() const;
  void clear();

 private:
  struct Entry {
    std::size_t hash = 0;
    std::uint32_t next = 0;  // of the same bucket; kNone: the last one
    KeyedTuple tuple;
  };
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  std::vector<std::size_t> key_;
  std::vector<std::size_t> probe_;
  algebra3d::MemoryAccount account_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> buckets_;  // the first entry of each; their number is a power of two
};

/// Lists of values that were seen before, as many as the work memory takes. Undefined equals undefined.
class SeenKeys {
 public:
  enum class Answer : std::uint8_t { is_new, was_seen, no_room };

  explicit SeenKeys(const Context& context) : account_(context.memory) {}
  /// Remembers these loaded values if they are new and there is room. An empty set takes anything; one that once had no
  /// room takes nothing more, so that what is new stays in order.
  Answer add(std::vector<Value> keys);
  void clear();

 private:
  struct Entry {
    std::size_t hash = 0;
    std::uint32_t next = 0;  // of the same bucket; kNone: the last one
  };
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  bool is_seen(std::size_t hash, const std::vector<Value>& keys) const;
  void link(std::size_t entry);

  algebra3d::MemoryAccount account_;
  std::vector<Entry> entries_;
  std::vector<Value> values_;           // of all entries, one list after the other
  std::vector<std::uint32_t> buckets_;  // the first entry of each; their number is a power of two
  bool is_full_ = false;
};

}  // namespace queries
