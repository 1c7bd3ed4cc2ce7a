#pragma once

#include <memory>
#include <vector>

#include "queries/streams/hash_table.h"
#include "queries/streams/mapping.h"
#include "queries/streams/partwise_join.h"
#include "queries/streams/tuple_file.h"

namespace queries {

/// The pairs of tuples of two streams with equal, defined values of two attributes: the one that passes first, then the
/// one that is held.
///
/// If the stream that is held fits into the work memory, pairs come in the order of the one that passes. If not, both
/// are divided by the hash of the key into temporary files, and joined file by file: always in the same order, but in
/// no particular one. Cost: linear, besides the pairs, as long as a file holds no more than fits into memory; equal
/// keys stay together, and are joined part by part if they must. Source: [kitsuregawa1983].
class HashJoin final : public TupleStream {
 public:
  HashJoin(TupleStreamPtr passing, TupleStreamPtr held, std::size_t passing_key, std::size_t held_key,
           const Context& context);
  Result<TuplePtr> next() override;

 private:
  /// A stream divided by the hash of a key.
  struct Division {
    std::vector<std::size_t> key;
    std::vector<std::shared_ptr<TupleFile>> files;
  };

  Status begin();
  Status divide(Division& division, const TuplePtr& tuple) const;
  Status divide_both();
  TupleStreamPtr next_file();

  TupleStreamPtr passing_;
  StreamParts held_;
  HashTable table_;
  const Context& context_;
  Division passing_division_;
  Division held_division_;
  std::size_t file_count_ = 0;  // 0: nothing was divided
  std::size_t next_file_ = 0;
  TupleStreamPtr current_;
};

}  // namespace queries
