#pragma once

#include <vector>

#include "algebra3d/base/work_memory.h"
#include "queries/streams/hash_chains.h"
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
  /// Nothing is left to be done once it is filled.
  void finish() {}
  /// Appends the tuples whose key equals the one of `probe`.
  Status find(const Tuple& probe, std::vector<TuplePtr>& found) const;
  /// All that it holds, in the order in which they came.
  std::vector<TuplePtr> tuples() const;
  void clear();

 private:
  std::vector<std::size_t> key_;
  std::vector<std::size_t> probe_;
  algebra3d::MemoryAccount account_;
  std::vector<KeyedTuple> held_;
  HashChains chains_;  // by the key
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
  bool is_seen(std::size_t hash, const std::vector<Value>& keys) const;

  algebra3d::MemoryAccount account_;
  std::vector<Value> values_;  // of all lists, one after the other
  HashChains chains_;
  bool is_full_ = false;
};

}  // namespace queries
