#pragma once

#include <optional>

#include "queries/streams/detail/sorting.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {

/// Splits a stream into runs of adjacent tuples with equal key attributes. Undefined equals undefined. Without keys all
/// tuples are one run.
class AdjacentGroups {
 public:
  struct Group {
    Group(std::vector<Value> its_keys, const Context& context) : keys(std::move(its_keys)), tuples(context) {}
    std::vector<Value> keys;
    TupleBuffer tuples;
  };

  AdjacentGroups(TupleStreamPtr tuples, std::vector<std::size_t> keys)
      : tuples_(std::move(tuples)), keys_(std::move(keys)) {}

  /// The next run, or nothing at the end.
  Result<std::optional<Group>> next(const Context& context);

 private:
  Status advance();

  TupleStreamPtr tuples_;
  std::vector<std::size_t> keys_;
  TuplePtr pending_;  // the first tuple of the next run
  std::vector<Value> pending_keys_;
  bool has_begun_ = false;
};

}  // namespace queries
