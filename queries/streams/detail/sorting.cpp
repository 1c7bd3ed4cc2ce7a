#include "queries/streams/detail/sorting.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "base/propagate.h"
#include "base/work_memory.h"
#include "queries/streams/column_buffer.h"
#include "queries/streams/detail/loaded_keys.h"
#include "queries/streams/detail/run_merge.h"

namespace queries {
namespace {

/// Sorts tuples that stand in columns, by prefixes of the first keys as numbers, and by the keys where these are equal.
class ColumnOrder {
 public:
  /// `keys`: of the attributes of `tuples`.
  ColumnOrder(const std::vector<SortKey>& keys, const ColumnBuffer& tuples, const Context& context)
      : keys_(keys), tuples_(tuples), context_(context) {}

  /// The memory for a tuple while it is sorted, besides itself.
  static constexpr std::size_t kBytesPerTuple = 2 * sizeof(std::array<std::uint64_t, 3>);

  /// The places of the tuples in their order; equal ones keep theirs. Interruptible.
  Result<std::vector<std::uint32_t>> sorted_places() const {
    if (tuples_.size() == 0) return std::vector<std::uint32_t>();
    return keys_.size() > 1 ? sorted_by_prefixes<2>() : sorted_by_prefixes<1>();
  }

 private:
  template <std::size_t Count>
  struct Entry {
    std::array<std::uint64_t, Count> prefixes = {};
    std::uint32_t place = 0;
  };

  template <std::size_t Count>
  bool is_before(const Entry<Count>& a, const Entry<Count>& b) const {
    std::size_t decided = 0;
    for (; decided < std::min(Count, keys_.size()); ++decided) {
      if (a.prefixes[decided] != b.prefixes[decided]) return a.prefixes[decided] < b.prefixes[decided];
      const SortKey& key = keys_[decided];
      const std::uint64_t prefix = key.is_descending ? ~a.prefixes[decided] : a.prefixes[decided];
      if (!tuples_.type(key.attribute).is_whole_in_prefix(prefix)) break;
    }
    for (std::size_t i = decided; i < keys_.size(); ++i) {
      const auto order = tuples_.compare(keys_[i].attribute, a.place, b.place);
      if (order != 0) return keys_[i].is_descending ? order > 0 : order < 0;
    }
    return a.place < b.place;
  }

  template <std::size_t Count>
  std::vector<Entry<Count>> entries() const {
    std::vector<Entry<Count>> result(tuples_.size());
    std::vector<std::uint64_t> prefixes;
    for (std::size_t i = 0; i < std::min(Count, keys_.size()); ++i) {
      prefixes.clear();
      prefixes.reserve(result.size());
      tuples_.append_prefixes(keys_[i].attribute, prefixes);
      for (std::size_t place = 0; place < result.size(); ++place)
        result[place].prefixes[i] = keys_[i].is_descending ? ~prefixes[place] : prefixes[place];
    }
    for (std::size_t place = 0; place < result.size(); ++place) result[place].place = static_cast<std::uint32_t>(place);
    return result;
  }

  template <std::size_t Count>
  Result<std::vector<std::uint32_t>> sorted_by_prefixes() const {
    // Below that many entries the counts cost more than comparisons.
    constexpr std::size_t kFew = 2048;
    std::vector<Entry<Count>> sorted = entries<Count>();
    if (sorted.size() < kFew) {
      sort_entries(sorted.begin(), sorted.end());
    } else {
      A3D_TRY(sort_by_first_prefix(sorted));
      A3D_TRY(sort_ties(sorted));
    }
    std::vector<std::uint32_t> places;
    places.reserve(sorted.size());
    for (const Entry<Count>& entry : sorted) places.push_back(entry.place);
    return places;
  }

  template <typename Iterator>
  void sort_entries(Iterator begin, Iterator end) const {
    std::sort(begin, end, [this](const auto& a, const auto& b) { return is_before(a, b); });
  }

  /// Radix sort by the bytes of the first prefix, the last byte first: stable. Source: [knuth1998], section 5.2.5.
  template <std::size_t Count>
  Status sort_by_first_prefix(std::vector<Entry<Count>>& entries) const {
    constexpr std::size_t kBytes = sizeof(std::uint64_t), kValues = 256;
    const auto byte_of = [](const Entry<Count>& entry, std::size_t byte) {
      return static_cast<std::size_t>(entry.prefixes[0] >> (8 * byte)) % kValues;
    };
    std::vector<std::array<std::uint32_t, kValues>> counts(kBytes);
    for (const Entry<Count>& entry : entries)
      for (std::size_t byte = 0; byte < kBytes; ++byte) ++counts[byte][byte_of(entry, byte)];
    std::vector<Entry<Count>> moved(entries.size());
    for (std::size_t byte = 0; byte < kBytes; ++byte) {
      A3D_TRY(context_.check_cancelled());
      if (counts[byte][byte_of(entries.front(), byte)] == entries.size()) continue;
      std::array<std::uint32_t, kValues> places{};
      std::exclusive_scan(counts[byte].begin(), counts[byte].end(), places.begin(), std::uint32_t{0});
      for (const Entry<Count>& entry : entries) moved[places[byte_of(entry, byte)]++] = entry;
      entries.swap(moved);
    }
    return {};
  }

  /// Sorts entries with equal first prefixes, if these do not say all.
  template <std::size_t Count>
  Status sort_ties(std::vector<Entry<Count>>& entries) const {
    const algebra3d::Type& type = tuples_.type(keys_.front().attribute);
    std::size_t steps = 0;
    for (auto begin = entries.begin(); begin != entries.end();) {
      const std::uint64_t prefix = begin->prefixes[0];
      auto end = std::next(begin);
      while (end != entries.end() && end->prefixes[0] == prefix) ++end;
      const std::uint64_t written = keys_.front().is_descending ? ~prefix : prefix;
      if (end - begin > 1 && (keys_.size() > 1 || !type.is_whole_in_prefix(written))) sort_entries(begin, end);
      begin = end;
      if (++steps % 1024 == 0) A3D_TRY(context_.check_cancelled());
    }
    return {};
  }

  const std::vector<SortKey>& keys_;
  const ColumnBuffer& tuples_;
  const Context& context_;
};

/// Tuples in the order of a list of their places.
class PlacedTuples final : public TupleStream {
 public:
  PlacedTuples(ColumnBuffer tuples, std::vector<std::uint32_t> places, std::size_t attribute_count)
      : tuples_(std::move(tuples)), places_(std::move(places)), attribute_count_(attribute_count) {}

  Result<TuplePtr> next() override {
    if (is_at_end()) return TuplePtr();
    return tuples_.tuple(places_[next_++], attribute_count_);
  }
  bool has_batches() const override { return true; }
  Result<const Batch*> next_batch(std::size_t most) override {
    if (is_at_end()) return nullptr;
    const auto places = std::span(places_).subspan(next_, std::min(most, places_.size() - next_));
    next_ += places.size();
    std::vector<const algebra3d::Type*> types;
    for (std::size_t attribute = 0; attribute < attribute_count_; ++attribute)
      types.push_back(&tuples_.type(attribute));
    batch_.set_types(types);
    for (std::size_t attribute = 0; attribute < attribute_count_; ++attribute)
      tuples_.gather(attribute, places, places.size(), {nullptr, places.size()}, batch_.columns[attribute]);
    batch_.ids.clear();
    for (const std::uint32_t place : places) batch_.ids.push_back(tuples_.id(place));
    batch_.finish(places.size());
    return &batch_.batch;
  }

 private:
  /// At the end the memory goes back.
  bool is_at_end() {
    if (next_ < places_.size()) return false;
    tuples_.clear();
    return true;
  }

  ColumnBuffer tuples_;
  std::vector<std::uint32_t> places_;
  std::size_t attribute_count_;
  std::size_t next_ = 0;
  OwnBatch batch_;
};

/// The last one of the first tuples so far: later tuples that do not precede it are not among the first.
class LastOfFirst {
 public:
  /// `place`: of that tuple.
  LastOfFirst(const std::vector<SortKey>& keys, const ColumnBuffer& tuples, std::uint32_t place) : keys_(keys) {
    for (const SortKey& key : keys_) values_.push_back(tuples.value(key.attribute, place));
  }

  /// Lists the rows of a batch that precede it.
  void select(const Batch& batch, std::vector<std::uint32_t>& selected) {
    prefixes_.clear();
    append_prefixes(*batch.columns[keys_.front().attribute], batch.rows, prefixes_);
    const std::uint64_t last = algebra3d::order_prefix(values_.front());
    const bool is_descending = keys_.front().is_descending;
    for (std::size_t i = 0; i < prefixes_.size(); ++i) {
      const auto row = static_cast<std::uint32_t>(batch.rows[i]);
      if (prefixes_[i] == last ? precedes(batch, row) : (prefixes_[i] < last) != is_descending) selected.push_back(row);
    }
  }

 private:
  bool precedes(const Batch& batch, std::uint32_t row) const {
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      const auto order = compare(batch.columns[keys_[i].attribute]->value(row), values_[i]);
      if (order != 0) return keys_[i].is_descending ? order > 0 : order < 0;
    }
    return false;
  }

  const std::vector<SortKey>& keys_;
  std::vector<Value> values_;
  std::vector<std::uint64_t> prefixes_;
};

/// Sorts tuples that come in batches: in memory as long as there is some, then in sorted runs in a file. If only the
/// first ones are wanted, those that are not among them are dropped now and then, and from then on before they are
/// kept.
class Sorter {
 public:
  Sorter(const std::vector<SortKey>& keys, std::optional<std::size_t> wanted, const Context& context)
      : order_(keys),
        keys_(keys),
        wanted_(wanted),
        context_(context),
        loaded_(order_.attributes()),
        tuples_(context.memory, ColumnOrder::kBytesPerTuple) {}

  Status add(const Batch& batch) {
    if (wanted_ == std::size_t{0}) return {};
    attribute_count_ = batch.columns.size();
    A3D_ASSIGN(const Batch* const loaded, loaded_.with_keys(batch));
    for (std::size_t i = 0; i < keys_.size(); ++i) keys_[i].attribute = loaded_.attribute(i);
    add_selected(*loaded);
    // Twice as many as are wanted, so that each tuple is sorted some two times at most.
    const bool is_dropping_due = wanted_ && tuples_.size() >= std::max(2 * *wanted_, kBatchTuples);
    if (wanted_ && (is_dropping_due || is_full())) A3D_TRY(drop_later_ones());
    if (!is_full()) return {};
    wanted_.reset();
    return write_run();
  }

  Result<TupleStreamPtr> finish() {
    if (runs_.empty()) {
      A3D_ASSIGN(std::vector<std::uint32_t> places, places_in_order());
      if (wanted_ && places.size() > *wanted_) places.resize(*wanted_);
      return TupleStreamPtr(std::make_shared<PlacedTuples>(std::move(tuples_), std::move(places), attribute_count_));
    }
    A3D_TRY(write_run());
    while (runs_.size() > merge_width()) A3D_TRY(merge_once());
    return TupleStreamPtr(std::make_shared<RunMerge>(file_, runs_, order_, context_));
  }

 private:
  Result<std::vector<std::uint32_t>> places_in_order() const { return sorted_places(tuples_, keys_, context_); }
  bool is_full() const { return tuples_.is_full(); }

  void add_selected(const Batch& batch) {
    if (!last_) return tuples_.add(batch);
    selected_.clear();
    last_->select(batch, selected_);
    if (selected_.empty()) return;
    Batch preceding = batch;
    preceding.rows = {selected_.data(), selected_.size()};
    tuples_.add(preceding);
  }

  Status drop_later_ones() {
    A3D_ASSIGN(std::vector<std::uint32_t> places, places_in_order());
    if (places.size() <= *wanted_) return {};
    places.resize(*wanted_);
    const std::uint32_t last = places.back();
    last_.emplace(keys_, tuples_, last);
    std::ranges::sort(places);
    tuples_.keep(places);
    return {};
  }

  Status write_run() {
    if (tuples_.size() == 0) return {};
    if (file_ == nullptr) {
      A3D_ASSIGN(file_, TupleFile::make(context_));
    }
    const std::uint64_t begin = file_->end();
    std::uint32_t steps = 0;
    A3D_ASSIGN(const std::vector<std::uint32_t> places, places_in_order());
    for (const std::uint32_t place : places) {
      if (++steps % 1024 == 0) A3D_TRY(context_.check_cancelled());
      A3D_TRY(file_->append(*tuples_.tuple(place, attribute_count_)));
    }
    runs_.push_back({begin, file_->end()});
    tuples_.clear();
    return {};
  }

  /// How many runs are merged at once: their buffers take a quarter of the memory.
  std::size_t merge_width() const {
    constexpr std::size_t kLeast = 4, kMost = 256;
    const std::size_t limit = context_.memory != nullptr ? context_.memory->limit() : std::size_t{1} << 30U;
    return std::clamp(limit / 4 / TupleFile::kBufferBytes, kLeast, kMost);
  }

  /// Makes one run of each `merge_width` of them, in a new file.
  Status merge_once() {
    A3D_ASSIGN(const auto target, TupleFile::make(context_));
    std::vector<SortedRun> merged;
    for (std::size_t first = 0; first < runs_.size(); first += merge_width()) {
      const std::size_t last = std::min(first + merge_width(), runs_.size());
      RunMerge source(file_, std::span(runs_).subspan(first, last - first), order_, context_);
      const std::uint64_t begin = target->end();
      A3D_TRY(for_each_tuple(source, context_, [&](const TuplePtr& tuple) { return target->append(*tuple); }));
      merged.push_back({begin, target->end()});
    }
    file_ = target;
    runs_ = std::move(merged);
    return {};
  }

  SortOrder order_;            // of tuples
  std::vector<SortKey> keys_;  // of their columns
  std::optional<std::size_t> wanted_;
  const Context& context_;
  LoadedKeys loaded_;
  ColumnBuffer tuples_;
  std::size_t attribute_count_ = 0;
  std::optional<LastOfFirst> last_;
  std::vector<std::uint32_t> selected_;
  std::shared_ptr<TupleFile> file_;
  std::vector<SortedRun> runs_;
};

}  // namespace

std::vector<SortKey> ascending(const std::vector<std::size_t>& attributes) {
  std::vector<SortKey> order;
  order.reserve(attributes.size());
  for (const std::size_t attribute : attributes) order.push_back({attribute, false});
  return order;
}

std::vector<std::size_t> all_attributes(const TypeExpr& tuple) {
  std::vector<std::size_t> attributes(tuple.attributes().size());
  std::iota(attributes.begin(), attributes.end(), std::size_t{0});
  return attributes;
}

Result<std::vector<Value>> loaded_keys(const Tuple& tuple, const std::vector<std::size_t>& attributes) {
  std::vector<Value> keys;
  keys.reserve(attributes.size());
  for (const std::size_t attribute : attributes) {
    A3D_ASSIGN(Value key, tuple.attributes[attribute].loaded());
    keys.push_back(std::move(key));
  }
  return keys;
}

std::strong_ordering compare_keys(const std::vector<Value>& a, const std::vector<Value>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (const auto order = compare(a[i], b[i]); order != 0) return order;
  return std::strong_ordering::equal;
}

Result<std::vector<std::uint32_t>> sorted_places(const ColumnBuffer& tuples, const std::vector<SortKey>& order,
                                                 const Context& context) {
  return ColumnOrder(order, tuples, context).sorted_places();
}

Result<TupleStreamPtr> sorted(TupleStream& tuples, const std::vector<SortKey>& order, const Context& context) {
  Sorter sorter(order, std::nullopt, context);
  A3D_TRY(for_each_batch(tuples, context, [&](const Batch& batch) { return sorter.add(batch); }));
  return sorter.finish();
}

Result<TupleStreamPtr> first_sorted(TupleStream& tuples, const std::vector<SortKey>& order, std::size_t count,
                                    const Context& context) {
  Sorter sorter(order, count, context);
  A3D_TRY(for_each_batch(tuples, context, [&](const Batch& batch) { return sorter.add(batch); }));
  return sorter.finish();
}

}  // namespace queries
