#pragma once

#include <unordered_map>
#include <vector>

#include "queries/streams/mapping.h"

namespace queries {

/// Tuples of a stream by the value of one attribute. Tuples whose key is undefined are left out; those of one key keep
/// the order of the stream.
class HashTable {
 public:
  /// Reads the stream to its end. Errors: those of the stream, interrupted.
  Status fill(TupleStream& tuples, std::size_t key, const Context& context);
  /// The tuples with that key, which is loaded and defined.
  std::vector<TuplePtr> matches(const Value& key) const;

 private:
  std::unordered_map<std::size_t, std::vector<std::pair<Value, TuplePtr>>> buckets_;
};

/// Lists of values that were seen before. Undefined equals undefined.
class SeenKeys {
 public:
  /// True if these loaded values are new.
  bool add(std::vector<Value> keys);

 private:
  std::unordered_map<std::size_t, std::vector<std::vector<Value>>> buckets_;
};

}  // namespace queries
