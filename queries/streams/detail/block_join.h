#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "base/propagate.h"
#include "queries/streams/detail/tuple_pair.h"
#include "queries/streams/mapping.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {

/// A stream that is read in blocks, each as large as a table in memory can hold.
class StreamBlocks final : public TupleStream {
 public:
  explicit StreamBlocks(TupleStreamPtr source) : source_(std::move(source)) {}

  /// The next tuple after the last block.
  Result<TuplePtr> next() override {
    if (pending_ != nullptr) return std::exchange(pending_, nullptr);
    return source_->next();
  }

  /// Fills an empty table with the next block. True if it was the last one. Errors: those of the stream and of
  /// `table.add`, interrupted.
  template <typename Table>
  Result<bool> fill(Table& table, const Context& context) {
    for (std::uint32_t step = 1;; ++step) {
      A3D_ASSIGN(TuplePtr tuple, next());
      if (tuple == nullptr) return true;
      if (step % 1024 == 0) A3D_TRY(context.check_cancelled());
      A3D_ASSIGN(const bool has_room, table.add(tuple));
      if (has_room) continue;
      pending_ = std::move(tuple);
      return false;
    }
  }

 private:
  TupleStreamPtr source_;
  TuplePtr pending_;  // the first tuple of the next block
};

/// The pairs of a block nested-loop join of two streams. The build side is read into a table, block by block; the probe
/// side is read once for each block, and each of its tuples looks up its partners. Order: block by block, and within a
/// block that of the probe side.
///
/// `Table` has `add(tuple)` (false if the table is full), `finish()`, `find(tuple, found)` and `clear()`, as HashTable.
/// Interruptible.
template <typename Table>
class BlockPairs {
 public:
  /// `table` is empty.
  BlockPairs(TupleStreamPtr build, TupleStreamPtr probe, Table table, const Context& context)
      : build_(std::move(build)), probe_(std::move(probe)), table_(std::move(table)), context_(context) {}
  /// The probe side is in a buffer already.
  BlockPairs(TupleStreamPtr build, TupleBuffer probe, Table table, const Context& context)
      : BlockPairs(std::move(build), TupleStreamPtr(), std::move(table), context) {
    probed_ = std::move(probe);
  }
  /// `table` has been filled with the whole build side.
  BlockPairs(Table table, TupleStreamPtr probe, const Context& context)
      : BlockPairs(nullptr, std::move(probe), std::move(table), context) {
    table_.finish();
    has_block_ = true;
    is_last_ = true;
  }

  Result<TuplePair> next() {
    while (position_ == found_.size()) {
      if (++steps_ % 256 == 0) A3D_TRY(context_.check_cancelled());
      if (!has_block_) {
        if (is_last_) return TuplePair();
        A3D_TRY(begin_block());
      }
      A3D_ASSIGN(current_, probe_->next());
      has_block_ = current_ != nullptr;
      found_.clear();
      position_ = 0;
      if (!has_block_) continue;
      if (keeps_probe_) A3D_TRY(probed_->add(current_));
      A3D_TRY(table_.find(*current_, found_));
    }
    return TuplePair{found_[position_++], current_};
  }

 private:
  Status begin_block() {
    table_.clear();
    A3D_ASSIGN(is_last_, build_.fill(table_, context_));
    table_.finish();
    has_block_ = true;
    if (probed_) {
      probe_ = probed_->scan();
      keeps_probe_ = false;
    } else if (!is_last_) {
      probed_.emplace(context_);
      keeps_probe_ = true;
    }
    return {};
  }

  StreamBlocks build_;
  TupleStreamPtr probe_;
  Table table_;
  const Context& context_;
  std::optional<TupleBuffer> probed_;  // copy of the probe side for the later blocks
  bool keeps_probe_ = false;
  bool has_block_ = false;
  bool is_last_ = false;
  TuplePtr current_;
  std::vector<TuplePtr> found_;
  std::size_t position_ = 0;
  std::uint32_t steps_ = 0;
};

/// A block nested-loop join: for each of the BlockPairs, the result of `Combine` for one tuple of the build side and
/// one of the probe side.
template <typename Table, typename Combine>
class BlockJoin final : public TupleStream {
 public:
  /// `arguments` are those of BlockPairs.
  template <typename... Arguments>
  explicit BlockJoin(Combine combine, Arguments&&... arguments)
      : pairs_(std::forward<Arguments>(arguments)...), combine_(std::move(combine)) {}

  Result<TuplePtr> next() override {
    A3D_ASSIGN(const TuplePair pair, pairs_.next());
    return pair.build == nullptr ? TuplePtr() : combine_(*pair.build, *pair.probe);
  }

 private:
  BlockPairs<Table> pairs_;
  Combine combine_;
};

/// The stream of a BlockJoin.
template <typename Table, typename Combine>
TupleStreamPtr block_join(TupleStreamPtr build, TupleStreamPtr probe, Table table, Combine combine,
                          const Context& context) {
  return std::make_shared<BlockJoin<Table, Combine>>(std::move(combine), std::move(build), std::move(probe),
                                                     std::move(table), context);
}
template <typename Table, typename Combine>
TupleStreamPtr block_join(Table table, TupleStreamPtr probe, Combine combine, const Context& context) {
  return std::make_shared<BlockJoin<Table, Combine>>(std::move(combine), std::move(table), std::move(probe), context);
}

}  // namespace queries
