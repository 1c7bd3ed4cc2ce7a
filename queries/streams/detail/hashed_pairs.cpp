#include "queries/streams/detail/hashed_pairs.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/propagate.h"
#include "queries/streams/detail/column_streams.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

class HashedPairs final : public TupleStream {
 public:
  HashedPairs(TupleStreamPtr probe, JoinTable table, JoinOutput output, const Context& context)
      : probe_(std::move(probe)),
        batches_(*probe_),
        table_(std::move(table)),
        output_(std::move(output)),
        context_(context),
        keys_({output_.keys.left}),
        search_(table_) {}

  Result<TuplePtr> next() override {
    while (true) {
      if (++steps_ % 1024 == 0) A3D_TRY(context_.check_cancelled());
      rows_.clear();
      places_.clear();
      search_.find(1, rows_, places_);
      if (places_.empty()) {
        A3D_ASSIGN(current_, probe_->next());
        if (current_ == nullptr) return TuplePtr();
        A3D_TRY(start_with(*current_));
        continue;
      }
      const TuplePtr partner = table_.tuple(places_.front());
      A3D_ASSIGN(const bool is_wanted, is_selected(current_, partner));
      if (is_wanted) return concatenated(*current_, *partner);
    }
  }

  bool has_batches() const override { return true; }
  Result<const Batch*> next_batch(std::size_t most) override {
    while (true) {
      A3D_TRY(context_.check_cancelled());
      rows_.clear();
      places_.clear();
      if (batch_ != nullptr) search_.find(most, rows_, places_);
      if (places_.empty()) {
        A3D_TRY(read_batch(most));
        if (batch_ == nullptr) return nullptr;
        continue;
      }
      A3D_TRY(select_pairs());
      if (joined_.batch.rows.count > 0) return &joined_.batch;
    }
  }

 private:
  /// Begins the search for the partners of a tuple.
  Status start_with(const Tuple& tuple) {
    A3D_ASSIGN(const Value key, tuple.attributes[output_.keys.left].loaded());
    if (!key_) key_.emplace(key.type());
    key_->restart(1);
    key_->set(0, key);
    search_.start(*key_, {nullptr, 1});
    return {};
  }

  /// Begins the search for the partners of further tuples: as many as are needed in any case for `most` pairs.
  Status read_batch(std::size_t most) {
    A3D_ASSIGN(batch_,
               batches_.next(std::max<std::size_t>(1, most / std::max<std::size_t>(1, table_.most_of_a_key()))));
    if (batch_ == nullptr) return {};
    A3D_ASSIGN(const Batch* const loaded, keys_.with_keys(*batch_));
    search_.start(*loaded->columns[keys_.attribute(0)], loaded->rows);
    return {};
  }

  /// Whether the predicate selects a pair.
  Result<bool> is_selected(const TuplePtr& left, const TuplePtr& right) const {
    if (output_.predicate == nullptr) return true;
    const std::array<Datum, 2> both = {Datum{left}, Datum{right}};
    A3D_ASSIGN(const Value holds, output_.predicate->call_for_value(both));
    return is_true(holds);
  }

  /// Makes the batch of the pairs that have been found and are selected.
  Status select_pairs() {
    if (output_.predicate != nullptr && !is_prepared_)
      predicate_ = output_.predicate->in_columns(batch_->columns.size());
    is_prepared_ = true;
    if (output_.predicate != nullptr && predicate_ == nullptr) A3D_TRY(select_by_tuples());
    join_columns();
    if (predicate_ == nullptr) return {};
    Batch& joined = joined_.batch;
    A3D_ASSIGN(const ValueColumn* const holds, predicate_->evaluate(joined, joined.rows));
    select_true(joined.rows, *holds, selected_);
    joined.rows = {selected_.data(), selected_.size()};
    return {};
  }

  Status select_by_tuples() {
    TuplePtr left;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (left == nullptr || rows_[i] != rows_[i - 1]) left = tuple_of(*batch_, rows_[i]);
      A3D_ASSIGN(const bool is_wanted, is_selected(left, table_.tuple(places_[i])));
      if (!is_wanted) continue;
      rows_[kept] = rows_[i];
      places_[kept++] = places_[i];
    }
    rows_.resize(kept);
    places_.resize(kept);
    return {};
  }

  // If no key has two tuples, the columns of the probe side stay as they are, and those of the table are filled in
  // their rows.
  void join_columns() {
    const std::size_t left_count = batch_->columns.size();
    make_columns();
    Batch& joined = joined_.batch;
    const SelectedRows rows{rows_.data(), rows_.size()};
    const bool is_shared = table_.most_of_a_key() == 1;
    joined.size = is_shared ? batch_->size : rows_.size();
    joined.rows = is_shared ? rows : SelectedRows{nullptr, rows_.size()};
    for (std::size_t attribute = 0; attribute < left_count; ++attribute) {
      if (!output_.is_read(attribute)) continue;
      if (is_shared)
        joined.columns[attribute] = batch_->columns[attribute];
      else
        gather(*batch_->columns[attribute], rows, joined_.columns[attribute]);
    }
    for (std::size_t attribute = 0; attribute < table_.attribute_count(); ++attribute)
      if (output_.is_read(left_count + attribute))
        table_.tuples().gather(attribute, places_, joined.size, joined.rows, joined_.columns[left_count + attribute]);
  }

  void make_columns() {
    if (!joined_.columns.empty()) return;
    std::vector<const algebra3d::Type*> types;
    for (const ValueColumn* const column : batch_->columns) types.push_back(&column->type());
    for (std::size_t attribute = 0; attribute < table_.attribute_count(); ++attribute)
      types.push_back(&table_.tuples().type(attribute));
    joined_.set_types(types);
  }

  TupleStreamPtr probe_;
  BatchReader batches_;
  JoinTable table_;
  JoinOutput output_;
  const Context& context_;
  LoadedKeys keys_;
  JoinSearch search_;
  TuplePtr current_;                // of the probe side
  std::optional<ValueColumn> key_;  // of it
  const Batch* batch_ = nullptr;    // of the probe side
  std::vector<std::uint32_t> rows_;
  std::vector<std::uint32_t> places_;  // of the partners
  ColumnFunctionPtr predicate_;
  bool is_prepared_ = false;
  std::vector<std::uint32_t> selected_;
  OwnBatch joined_;
  std::uint32_t steps_ = 0;
};

}  // namespace

TupleStreamPtr hashed_pairs(TupleStreamPtr probe, JoinTable table, JoinOutput output, const Context& context) {
  return std::make_shared<HashedPairs>(std::move(probe), std::move(table), std::move(output), context);
}

}  // namespace queries
