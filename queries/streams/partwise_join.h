#pragma once

#include <optional>
#include <vector>

#include "queries/streams/mapping.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {

/// A stream that is read part by part, each as large as some table in memory can take.
class StreamParts {
 public:
  explicit StreamParts(TupleStreamPtr source) : source_(std::move(source)) {}

  /// Fills an empty table with the next part. True if it was the last one. Errors: those of the stream and of
  /// `table.add`, interrupted.
  template <typename Table>
  Result<bool> fill(Table& table, const Context& context) {
    for (std::uint32_t step = 1;; ++step) {
      if (pending_ == nullptr) {
        ASSIGN_OR_RETURN(pending_, source_->next());
        if (pending_ == nullptr) return true;
      }
      if (step % 1024 == 0) RETURN_IF_ERROR(context.check_cancelled());
      ASSIGN_OR_RETURN(const bool has_room, table.add(pending_));
      if (!has_room) return false;
      pending_ = nullptr;
    }
  }

 private:
  TupleStreamPtr source_;
  TuplePtr pending_;  // the first tuple of the next part
};

/// The pairs of tuples of two streams that belong together: one is held in a table, the other passes by, each tuple
/// asking for its partners. If the table cannot take all of the one stream, it takes it in parts, and the other stream
/// passes by once for each: pairs then come part by part, and within a part in the order of the stream that passes.
///
/// `Table` has `add(tuple)`, false if it has no room, `finish()`, `find(tuple, found)` and `clear()`, as HashTable.
/// `Combine` makes the resulting tuple of the one that is held and the one that passes. Interruptible.
template <typename Table, typename Combine>
class PartwiseJoin {
 public:
  PartwiseJoin(TupleStreamPtr held, TupleStreamPtr passing, Table table, Combine combine, const Context& context)
      : held_(std::move(held)),
        passing_(std::move(passing)),
        table_(std::move(table)),
        combine_(std::move(combine)),
        context_(context) {}

  Result<TuplePtr> next() {
    while (position_ == found_.size()) {
      if (++steps_ % 256 == 0) RETURN_IF_ERROR(context_.check_cancelled());
      if (!has_part_) {
        if (is_last_) return TuplePtr();
        RETURN_IF_ERROR(begin_part());
      }
      ASSIGN_OR_RETURN(current_, passing_->next());
      has_part_ = current_ != nullptr;
      found_.clear();
      position_ = 0;
      if (!has_part_) continue;
      if (keeps_passing_) RETURN_IF_ERROR(passed_->add(current_));
      RETURN_IF_ERROR(table_.find(*current_, found_));
    }
    return combine_(*found_[position_++], *current_);
  }

 private:
  Status begin_part() {
    table_.clear();
    ASSIGN_OR_RETURN(is_last_, held_.fill(table_, context_));
    table_.finish();
    has_part_ = true;
    if (passed_) {
      passing_ = passed_->scan();
      keeps_passing_ = false;
    } else if (!is_last_) {
      passed_.emplace(context_);
      keeps_passing_ = true;
    }
    return {};
  }

  StreamParts held_;
  TupleStreamPtr passing_;
  Table table_;
  Combine combine_;
  const Context& context_;
  std::optional<TupleBuffer> passed_;  // what passes, for the later parts
  bool keeps_passing_ = false;
  bool has_part_ = false;
  bool is_last_ = false;
  TuplePtr current_;
  std::vector<TuplePtr> found_;
  std::size_t position_ = 0;
  std::uint32_t steps_ = 0;
};

/// The stream of a PartwiseJoin.
template <typename Table, typename Combine>
TupleStreamPtr partwise_join(TupleStreamPtr held, TupleStreamPtr passing, Table table, Combine combine,
                             const Context& context) {
  return make_stream(
      [join = PartwiseJoin<Table, Combine>(std::move(held), std::move(passing), std::move(table), std::move(combine),
                                           context)]() mutable { return join.next(); });
}

}  // namespace queries
