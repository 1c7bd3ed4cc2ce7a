#include "queries/streams/detail/hash_groups.h"

#include <algorithm>
#include <array>
#include <utility>

#include "algebra3d/operators/registry/aggregate.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"
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
        put_aside_(context) {
    for (const SortKey& key : grouping_.order) {
      const auto found = std::ranges::find(grouping_.keys, key.attribute);
      order_.push_back({static_cast<std::size_t>(found - grouping_.keys.begin()), key.is_descending});
    }
  }

  Status take(const Batch& batch) {
    table_.find_numbers(batch, numbers_);
    for (std::size_t i = 0; i < batch.rows.count; ++i) {
      const std::size_t row = batch.rows[i];
      const std::uint32_t number = numbers_[i];
      if (number == groups_.size()) groups_.push_back(new_group(batch, row));
      if (number == KeyTable::kNoRoom)
        A3D_TRY(put_aside_.add(tuple_of(batch, row)));
      else
        ++groups_[number].count;
    }
    std::size_t place = 0;
    for (const GroupAggregate& each : grouping_.aggregates)
      if (each.call) A3D_TRY(aggregate(batch, *batch.columns[each.attribute], place++));
    return {};
  }

  /// To be called when all tuples have been taken.
  Status finish() {
    table_.clear();
    sequence_ = in_order();
    if (put_aside_.is_empty()) return {};
    A3D_ASSIGN(TupleStreamPtr in_order, sorted(*put_aside_.scan(), grouping_.order, context_));
    aside_.emplace(std::move(in_order), grouping_.keys);
    A3D_ASSIGN(next_aside_, aside_->next(context_));
    return {};
  }

  Result<TuplePtr> next() override {
    if (position_ % 1024 == 0) A3D_TRY(context_.check_cancelled());
    if (next_aside_ &&
        (position_ == sequence_.size() || precedes(next_aside_->keys, groups_[sequence_[position_]].keys)))
      return group_aside();
    if (position_ == sequence_.size()) return TuplePtr();
    Group& group = groups_[sequence_[position_++]];
    auto tuple = std::make_shared<Tuple>(Tuple{std::move(group.keys)});
    auto aggregation = group.aggregates.begin();
    for (const GroupAggregate& each : grouping_.aggregates) {
      if (!each.call) {
        tuple->attributes.push_back(Value::of(group.count));
        continue;
      }
      A3D_ASSIGN(Value result, (aggregation++)->finish(context_));
      tuple->attributes.push_back(std::move(result));
    }
    group.aggregates.clear();
    return TuplePtr(std::move(tuple));
  }

 private:
  struct Group {
    std::vector<Value> keys;
    std::int64_t count = 0;
    std::vector<Aggregation> aggregates;  // without the counts
  };

  static std::size_t bytes_of_group(const HashGrouping& grouping) {
    return sizeof(Group) + grouping.keys.size() * 2 * sizeof(Value) +
           grouping.aggregates.size() * (sizeof(Aggregation) + kStateBytes);
  }

  Group new_group(const Batch& batch, std::size_t row) const {
    Group group;
    for (const std::size_t attribute : grouping_.keys) group.keys.push_back(batch.columns[attribute]->value(row));
    for (const GroupAggregate& each : grouping_.aggregates)
      if (each.call) group.aggregates.emplace_back(*each.call);
    return group;
  }

  Status aggregate(const Batch& batch, const ValueColumn& column, std::size_t place) {
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      if (numbers_[i] == KeyTable::kNoRoom) continue;
      const auto row = static_cast<std::uint32_t>(batch.rows[i]);
      A3D_TRY(groups_[numbers_[i]].aggregates[place].step_rows(column, {&row, 1}, context_));
    }
    return {};
  }

  bool precedes(const std::vector<Value>& a, const std::vector<Value>& b) const {
    for (const SortKey& key : order_) {
      const auto order = compare(a[key.attribute], b[key.attribute]);
      if (order != 0) return key.is_descending ? order > 0 : order < 0;
    }
    return false;
  }

  /// A group with the prefixes (Type::order_prefix) of its first keys in the order.
  struct Prefixed {
    std::array<std::uint64_t, 2> prefixes = {};
    std::uint32_t number = 0;
  };

  bool precedes(const Prefixed& a, const Prefixed& b) const {
    for (std::size_t i = 0; i < std::min(order_.size(), a.prefixes.size()); ++i) {
      if (a.prefixes[i] != b.prefixes[i]) return (a.prefixes[i] < b.prefixes[i]) != order_[i].is_descending;
      if (!groups_[a.number].keys[order_[i].attribute].type().is_whole_in_prefix(a.prefixes[i])) break;
    }
    return precedes(groups_[a.number].keys, groups_[b.number].keys);
  }

  /// The numbers of the groups in their order.
  std::vector<std::uint32_t> in_order() const {
    std::vector<Prefixed> groups(groups_.size());
    for (std::uint32_t number = 0; number < groups.size(); ++number) {
      groups[number].number = number;
      for (std::size_t i = 0; i < std::min(order_.size(), groups[number].prefixes.size()); ++i)
        groups[number].prefixes[i] = order_prefix(groups_[number].keys[order_[i].attribute]);
    }
    std::ranges::sort(groups, [&](const Prefixed& a, const Prefixed& b) { return precedes(a, b); });
    std::vector<std::uint32_t> numbers;
    numbers.reserve(groups.size());
    for (const Prefixed& group : groups) numbers.push_back(group.number);
    return numbers;
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
  std::vector<Group> groups_;           // by the number of their key
  std::vector<std::uint32_t> numbers_;  // of the keys of a batch
  std::vector<SortKey> order_;          // of the places of keys
  std::vector<std::uint32_t> sequence_;
  std::size_t position_ = 0;  // in the sequence
  std::optional<AdjacentGroups> aside_;
  std::optional<AdjacentGroups::Group> next_aside_;
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
