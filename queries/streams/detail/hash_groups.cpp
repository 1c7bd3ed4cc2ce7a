#include "queries/streams/detail/hash_groups.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "algebra3d/operators/registry/aggregate.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"
#include "queries/streams/column_buffer.h"
#include "queries/streams/detail/adjacent_groups.h"
#include "queries/streams/detail/key_table.h"
#include "queries/streams/detail/sorting.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"

namespace queries {
namespace {

using algebra3d::Aggregation;

/// Estimated bytes of the state of an aggregate: the exact sum of reals is the largest.
constexpr std::size_t kStateBytes = 768;

class HashGroups final : public TupleStream {
 public:
  HashGroups(TypeExpr tuple, HashGrouping grouping, DatumList functions, Context& context)
      : tuple_(std::move(tuple)),
        grouping_(std::move(grouping)),
        functions_(std::move(functions)),
        context_(context),
        table_(grouping_.keys, bytes_of_group(grouping_), context),
        put_aside_(context),
        aggregates_(grouping_.aggregates.size()) {
    for (const SortKey& key : grouping_.order) {
      const auto found = std::ranges::find(grouping_.keys, key.attribute);
      order_.push_back({static_cast<std::size_t>(found - grouping_.keys.begin()), key.is_descending});
    }
  }

  Status take(const Batch& batch) {
    table_.find_numbers(batch, numbers_);
    first_rows_.clear();
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      const std::size_t row = batch.rows[i];
      if (numbers_[i] == KeyTable::kNoRoom) {
        A3D_TRY(put_aside_.add(tuple_of(batch, row)));
        continue;
      }
      if (numbers_[i] == counts_.size()) add_group(row);
      ++counts_[numbers_[i]];
    }
    keep_keys(batch);
    for (std::size_t which = 0; which < aggregates_.size(); ++which)
      if (const GroupAggregate& each = grouping_.aggregates[which]; each.call)
        A3D_TRY(aggregate(batch, *batch.columns[each.attribute], aggregates_[which]));
    return {};
  }

  /// To be called when all tuples have been taken.
  Status finish() {
    table_.clear();
    A3D_ASSIGN(sequence_, sorted_places(keys_, order_, context_));
    if (put_aside_.is_empty()) return {};
    A3D_ASSIGN(TupleStreamPtr in_order, sorted(*put_aside_.scan(), grouping_.order, context_));
    aside_.emplace(std::move(in_order), grouping_.keys);
    A3D_ASSIGN(next_aside_, aside_->next(context_));
    return {};
  }

  Result<TuplePtr> next() override {
    if (position_ % 1024 == 0) A3D_TRY(context_.check_cancelled());
    if (next_aside_ && (position_ == sequence_.size() || precedes(next_aside_->keys, sequence_[position_])))
      return group_aside();
    if (position_ == sequence_.size()) return TuplePtr();
    const std::uint32_t group = sequence_[position_++];
    auto tuple = std::make_shared<Tuple>();
    for (std::size_t key = 0; key < grouping_.keys.size(); ++key) tuple->attributes.push_back(keys_.value(key, group));
    for (std::size_t which = 0; which < aggregates_.size(); ++which) {
      A3D_ASSIGN(Value result, result_of(which, group));
      tuple->attributes.push_back(std::move(result));
    }
    return TuplePtr(std::move(tuple));
  }

  bool has_batches() const override { return !next_aside_; }
  Result<const Batch*> next_batch(std::size_t most) override {
    A3D_TRY(context_.check_cancelled());
    const auto groups = std::span(sequence_).subspan(position_, std::min(most, sequence_.size() - position_));
    if (groups.empty()) return nullptr;
    position_ += groups.size();
    results_.set_types(grouping_.result_types);
    const std::size_t key_count = grouping_.keys.size();
    for (std::size_t key = 0; key < key_count; ++key)
      keys_.gather(key, groups, groups.size(), {nullptr, groups.size()}, results_.columns[key]);
    for (std::size_t which = 0; which < aggregates_.size(); ++which) {
      ValueColumn& column = results_.columns[key_count + which];
      column.restart(groups.size());
      for (std::size_t i = 0; i < groups.size(); ++i) {
        A3D_ASSIGN(const Value result, result_of(which, groups[i]));
        column.set(i, result);
      }
    }
    results_.finish(groups.size());
    return &results_.batch;
  }

 private:
  static std::size_t bytes_of_group(const HashGrouping& grouping) {
    return 2 * sizeof(std::int64_t) + grouping.keys.size() * 2 * sizeof(std::string) +
           grouping.aggregates.size() * (sizeof(Aggregation) + kStateBytes);
  }

  /// Adds the group of a tuple with a new key.
  void add_group(std::size_t row) {
    first_rows_.push_back(static_cast<std::uint32_t>(row));
    counts_.push_back(0);
    for (std::size_t which = 0; which < aggregates_.size(); ++which)
      if (const GroupAggregate& each = grouping_.aggregates[which]; each.call)
        aggregates_[which].emplace_back(*each.call);
  }

  /// Keeps the keys of the new groups.
  void keep_keys(const Batch& batch) {
    Batch keys;
    keys.size = batch.size;
    for (const std::size_t attribute : grouping_.keys) keys.columns.push_back(batch.columns[attribute]);
    keys.rows = {first_rows_.data(), first_rows_.size()};
    keys_.add(keys);
  }

  Status aggregate(const Batch& batch, const ValueColumn& column, std::vector<Aggregation>& groups) {
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      if (numbers_[i] == KeyTable::kNoRoom) continue;
      const auto row = static_cast<std::uint32_t>(batch.rows[i]);
      A3D_TRY(groups[numbers_[i]].step_rows(column, {&row, 1}, context_));
    }
    return {};
  }

  /// The result of an aggregate for a group, once.
  Result<Value> result_of(std::size_t which, std::uint32_t group) {
    if (!grouping_.aggregates[which].call) return Value::of(counts_[group]);
    return aggregates_[which][group].finish(context_);
  }

  bool precedes(const std::vector<Value>& keys, std::uint32_t group) const {
    for (const SortKey& key : order_) {
      const auto order = compare(keys[key.attribute], keys_.value(key.attribute, group));
      if (order != 0) return key.is_descending ? order > 0 : order < 0;
    }
    return false;
  }

  Result<TuplePtr> group_aside() {
    Tuple row{next_aside_->keys};
    const RelationPtr group = std::make_shared<MemoryRelation>(tuple_, next_aside_->tuples);
    A3D_TRY(append_results(functions_, Datum{group}, row.attributes));
    A3D_ASSIGN(next_aside_, aside_->next(context_));
    return TuplePtr(std::make_shared<const Tuple>(std::move(row)));
  }

  TypeExpr tuple_;
  HashGrouping grouping_;
  DatumList functions_;
  Context& context_;
  KeyTable table_;
  TupleBuffer put_aside_;
  // Of the groups, by the numbers of their keys.
  ColumnBuffer keys_{nullptr};  // counted by the table
  std::vector<std::int64_t> counts_;
  std::vector<std::vector<Aggregation>> aggregates_;  // by function; empty for numbers of tuples
  std::vector<std::uint32_t> numbers_;                // of the keys of a batch
  std::vector<std::uint32_t> first_rows_;             // of the groups that begin in it
  std::vector<SortKey> order_;                        // of the places of keys
  std::vector<std::uint32_t> sequence_;
  std::size_t position_ = 0;  // in the sequence
  std::optional<AdjacentGroups> aside_;
  std::optional<AdjacentGroups::Group> next_aside_;
  OwnBatch results_;
};

}  // namespace

Result<TupleStreamPtr> hashed_groups(TupleStream& tuples, const TypeExpr& tuple, const HashGrouping& grouping,
                                     const DatumList& functions, Context& context) {
  const auto groups = std::make_shared<HashGroups>(tuple, grouping, functions, context);
  A3D_TRY(for_each_batch(tuples, context, [&](const Batch& batch) { return groups->take(batch); }));
  A3D_TRY(groups->finish());
  return TupleStreamPtr(groups);
}

}  // namespace queries
