#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "queries/streams/mapping.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {

/// A stream that is read part by part, each as large as some table in memory can take.
class StreamParts final : public TupleStream {
 public:
  explicit StreamParts(TupleStreamPtr source) : source_(std::move(source)) {}

  /// The next tuple that is in no part yet.
  Result<TuplePtr> next() override {
    if (pending_ != nullptr) return std::exchange(pending_, nullptr);
    return source_->next();
  }

  /// Fills an empty table with the next part. True if it was the last one. Errors: those of the stream and of
  /// `table.add`, interrupted.
  template <typename Table>
  Result<bool> fill(Table& table, const Context& context) {
    for (std::uint32_t step = 1;; ++step) {
      ASSIGN_OR_RETURN(TuplePtr tuple, next());
      if (tuple == nullptr) return true;
      if (step % 1024 == 0) RETURN_IF_ERROR(context.check_cancelled());
      ASSIGN_OR_RETURN(const bool has_room, table.add(tuple));
      if (has_room) continue;
      pending_ = std::move(tuple);
      return false;
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
class PartwiseJoin final : public TupleStream {
 public:
  /// `table` is empty.
  PartwiseJoin(TupleStreamPtr held, TupleStreamPtr passing, Table table, Combine combine, const Context& context)
      : held_(std::move(held)),
        passing_(std::move(passing)),
        table_(std::move(table)),
        combine_(std::move(combine)),
        context_(context) {}
  /// `table` has been filled with all that is held.
  PartwiseJoin(Table table, TupleStreamPtr passing, Combine combine, const Context& context)
      : PartwiseJoin(nullptr, std::move(passing), std::move(table), std::move(combine), context) {
    table_.finish();
    has_part_ = true;
    is_last_ = true;
  }

  Result<TuplePtr> next() override {
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
  return std::make_shared<PartwiseJoin<Table, Combine>>(std::move(held), std::move(passing), std::move(table),
                                                        std::move(combine), context);
}
template <typename Table, typename Combine>
TupleStreamPtr partwise_join(Table table, TupleStreamPtr passing, Combine combine, const Context& context) {
  return std::make_shared<PartwiseJoin<Table, Combine>>(std::move(table), std::move(passing), std::move(combine),
                                                        context);
}

}  // namespace queries
