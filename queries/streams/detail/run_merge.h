#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "queries/streams/detail/keyed_tuple.h"
#include "queries/streams/detail/tuple_file.h"
#include "queries/streams/mapping.h"

namespace queries {

/// A sort order by several keys, prepared for many comparisons.
class SortOrder {
 public:
  explicit SortOrder(const std::vector<SortKey>& keys);

  const std::vector<std::size_t>& attributes() const { return attributes_; }
  Result<KeyedTuple> keyed(TuplePtr tuple) const { return KeyedTuple::make(std::move(tuple), attributes_); }
  /// A prefix of the first key as a number: if it is less, the tuple comes first.
  std::uint64_t prefix(const KeyedTuple& tuple) const {
    if (attributes_.empty()) return 0;
    const std::uint64_t result = order_prefix(tuple.key(attributes_, 0));
    return is_descending_.front() ? ~result : result;
  }
  /// Compares two tuples with equal prefixes by all keys.
  std::strong_ordering compare_further(const KeyedTuple& a, const KeyedTuple& b) const;

 private:
  std::vector<std::size_t> attributes_;
  std::vector<bool> is_descending_;
};

/// A sorted part of a file of tuples.
struct SortedRun {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

/// Merges several sorted runs to one sorted stream; among equal tuples those of the earlier run come first.
/// Interruptible. Memory: a buffer and a tuple for each run.
class RunMerge final : public TupleStream {
 public:
  RunMerge(const std::shared_ptr<TupleFile>& file, std::span<const SortedRun> runs, SortOrder order,
           const algebra3d::Context& context);
  Result<TuplePtr> next() override;

 private:
  /// A run with its next tuple.
  struct Head {
    std::shared_ptr<TupleFile::Scan> scan;
    std::size_t number = 0;
    KeyedTuple tuple;
    std::uint64_t prefix = 0;
  };

  Status start();
  Result<bool> advance(Head& head) const;
  bool is_after(const Head& a, const Head& b) const;

  SortOrder order_;
  const algebra3d::Context& context_;
  std::vector<Head> heads_;  // a heap after the first `next`: the least one first
  bool has_begun_ = false;
  std::uint32_t steps_ = 0;
};

}  // namespace queries
