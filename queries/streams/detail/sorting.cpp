#include "queries/streams/detail/sorting.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

#include "base/propagate.h"
#include "base/work_memory.h"
#include "queries/streams/detail/keyed_tuple.h"
#include "queries/streams/detail/tuple_file.h"

namespace queries {
namespace {

/// A sort order by several keys, prepared for many comparisons.
class SortOrder {
 public:
  explicit SortOrder(const std::vector<SortKey>& keys);

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

SortOrder::SortOrder(const std::vector<SortKey>& keys) {
  for (const SortKey& key : keys) {
    attributes_.push_back(key.attribute);
    is_descending_.push_back(key.is_descending);
  }
}

std::strong_ordering SortOrder::compare_further(const KeyedTuple& a, const KeyedTuple& b) const {
  const bool first_is_done = !attributes_.empty() && a.key(attributes_, 0).type().is_whole_in_prefix();
  for (std::size_t i = first_is_done ? 1 : 0; i < attributes_.size(); ++i) {
    const auto order = algebra3d::compare(a.key(attributes_, i), b.key(attributes_, i));
    if (order != 0) return is_descending_[i] ? 0 <=> order : order;
  }
  return std::strong_ordering::equal;
}

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

RunMerge::RunMerge(const std::shared_ptr<TupleFile>& file, std::span<const SortedRun> runs, SortOrder order,
                   const algebra3d::Context& context)
    : order_(std::move(order)), context_(context) {
  for (const SortedRun& run : runs) {
    Head& head = heads_.emplace_back();
    head.scan = file->scan(run.begin, run.end);
    head.number = heads_.size();
  }
}

bool RunMerge::is_after(const Head& a, const Head& b) const {
  if (a.prefix != b.prefix) return a.prefix > b.prefix;
  const auto order = order_.compare_further(a.tuple, b.tuple);
  return order != 0 ? order > 0 : a.number > b.number;
}

/// False at the end of the run.
Result<bool> RunMerge::advance(Head& head) const {
  A3D_ASSIGN(TuplePtr tuple, head.scan->next());
  if (tuple == nullptr) return false;
  A3D_ASSIGN(head.tuple, order_.keyed(std::move(tuple)));
  head.prefix = order_.prefix(head.tuple);
  return true;
}

Status RunMerge::start() {
  std::vector<Head> filled;
  for (Head& head : heads_) {
    A3D_ASSIGN(const bool has_tuple, advance(head));
    if (has_tuple) filled.push_back(std::move(head));
  }
  heads_ = std::move(filled);
  std::ranges::make_heap(heads_, [this](const Head& a, const Head& b) { return is_after(a, b); });
  return {};
}

Result<TuplePtr> RunMerge::next() {
  if (!std::exchange(has_begun_, true)) A3D_TRY(start());
  if (heads_.empty()) return TuplePtr();
  if (++steps_ % 1024 == 0) A3D_TRY(context_.check_cancelled());
  const auto after = [this](const Head& a, const Head& b) { return is_after(a, b); };
  std::ranges::pop_heap(heads_, after);
  Head& least = heads_.back();
  TuplePtr result = std::move(least.tuple.tuple());
  A3D_ASSIGN(const bool has_tuple, advance(least));
  if (has_tuple)
    std::ranges::push_heap(heads_, after);
  else
    heads_.pop_back();
  return result;
}

/// Where a tuple stands among those that are kept, with the beginning of its first key.
struct Position {
  std::uint64_t prefix;
  std::uint32_t index;
};

/// The memory for one tuple besides itself while it is sorted.
constexpr std::size_t kBytesToSort = sizeof(Position);

/// Tuples that are sorted in memory.
class SortedTuples final : public TupleStream {
 public:
  SortedTuples(std::vector<KeyedTuple> tuples, std::vector<Position> positions, algebra3d::MemoryAccount account)
      : tuples_(std::move(tuples)), positions_(std::move(positions)), account_(std::move(account)) {}

  Result<TuplePtr> next() override {
    if (next_ == positions_.size()) {
      tuples_.clear();
      account_.clear();
      return TuplePtr();
    }
    KeyedTuple& kept = tuples_[positions_[next_++].index];
    return std::move(kept.tuple());
  }

 private:
  std::vector<KeyedTuple> tuples_;
  std::vector<Position> positions_;
  algebra3d::MemoryAccount account_;
  std::size_t next_ = 0;
};

class Sorter {
 public:
  Sorter(const std::vector<SortKey>& keys, const Context& context)
      : order_(keys), context_(context), account_(context.memory) {}

  Status add(TuplePtr tuple) {
    A3D_ASSIGN(KeyedTuple keyed, order_.keyed(std::move(tuple)));
    const std::size_t bytes = keyed.bytes() + kBytesToSort;
    if (!account_.take(bytes) || tuples_.size() == std::numeric_limits<std::uint32_t>::max()) {
      A3D_TRY(write_run());
      // A single tuple is kept however large it is.
      static_cast<void>(account_.take(bytes));
    }
    tuples_.push_back(std::move(keyed));
    return {};
  }

  Result<TupleStreamPtr> finish() {
    if (runs_.empty()) {
      A3D_ASSIGN(std::vector<Position> positions, sorted_positions());
      return TupleStreamPtr(
          std::make_shared<SortedTuples>(std::move(tuples_), std::move(positions), std::move(account_)));
    }
    A3D_TRY(write_run());
    while (runs_.size() > merge_width()) A3D_TRY(merge_once());
    return TupleStreamPtr(std::make_shared<RunMerge>(file_, runs_, order_, context_));
  }

 private:
  bool is_before(const Position& a, const Position& b) const {
    if (a.prefix != b.prefix) return a.prefix < b.prefix;
    const auto order = order_.compare_further(tuples_[a.index], tuples_[b.index]);
    // The positions make the order total, so that equal tuples keep theirs.
    return order != 0 ? order < 0 : a.index < b.index;
  }

  /// Block by block, and then twice as large ones, so that a statement can be ended in between.
  Result<std::vector<Position>> sorted_positions() const {
    constexpr std::size_t kBlock = std::size_t{1} << 17U;
    const auto before = [this](const Position& a, const Position& b) { return is_before(a, b); };
    std::vector<Position> positions(tuples_.size());
    for (std::uint32_t i = 0; i < positions.size(); ++i) positions[i] = {order_.prefix(tuples_[i]), i};
    const auto place = [&](std::size_t index) {
      return positions.begin() + static_cast<std::ptrdiff_t>(std::min(index, positions.size()));
    };
    for (std::size_t begin = 0; begin < positions.size(); begin += kBlock) {
      A3D_TRY(context_.check_cancelled());
      std::sort(place(begin), place(begin + kBlock), before);
    }
    for (std::size_t width = kBlock; width < positions.size(); width *= 2)
      for (std::size_t begin = 0; begin + width < positions.size(); begin += 2 * width) {
        A3D_TRY(context_.check_cancelled());
        std::inplace_merge(place(begin), place(begin + width), place(begin + 2 * width), before);
      }
    return positions;
  }

  Status write_run() {
    if (tuples_.empty()) return {};
    if (file_ == nullptr) {
      A3D_ASSIGN(file_, TupleFile::make(context_));
    }
    const std::uint64_t begin = file_->end();
    std::uint32_t steps = 0;
    A3D_ASSIGN(const std::vector<Position> positions, sorted_positions());
    for (const Position& position : positions) {
      if (++steps % 1024 == 0) A3D_TRY(context_.check_cancelled());
      A3D_TRY(file_->append(*tuples_[position.index].tuple()));
    }
    runs_.push_back({begin, file_->end()});
    tuples_.clear();
    account_.clear();
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

  SortOrder order_;
  const Context& context_;
  algebra3d::MemoryAccount account_;
  std::vector<KeyedTuple> tuples_;
  std::shared_ptr<TupleFile> file_;
  std::vector<SortedRun> runs_;
};

/// The first tuples of a sort order. The last of them is at the top of a heap, so that most tuples are dropped after
/// one comparison.
class FirstTuples {
 public:
  FirstTuples(const std::vector<SortKey>& keys, std::size_t count, const Context& context)
      : order_(keys), count_(count), account_(context.memory), sorter_(keys, context) {}

  Status add(TuplePtr tuple) {
    if (count_ == 0) return {};
    if (is_too_large_) return sorter_.add(std::move(tuple));
    A3D_ASSIGN(KeyedTuple keyed, order_.keyed(std::move(tuple)));
    Kept kept{order_.prefix(keyed), number_++, std::move(keyed)};
    const auto before = [this](const Kept& a, const Kept& b) { return is_before(a, b); };
    if (heap_.size() == count_) {
      if (!is_before(kept, heap_.front())) return {};
      std::ranges::pop_heap(heap_, before);
      bytes_ -= bytes_of(heap_.back());
      heap_.pop_back();
    }
    bytes_ += bytes_of(kept);
    heap_.push_back(std::move(kept));
    std::ranges::push_heap(heap_, before);
    const bool has_room = bytes_ <= account_.used() || account_.take(bytes_ - account_.used());
    return has_room ? Status() : give_up();
  }

  Result<TupleStreamPtr> finish() {
    if (is_too_large_) return sorter_.finish();
    std::ranges::sort_heap(heap_, [this](const Kept& a, const Kept& b) { return is_before(a, b); });
    return make_stream(
        [heap = std::move(heap_), account = std::move(account_), index = std::size_t{0}]() mutable -> Result<TuplePtr> {
          return index == heap.size() ? TuplePtr() : std::move(heap[index++].tuple.tuple());
        });
  }

 private:
  struct Kept {
    std::uint64_t prefix;
    std::uint64_t number;  // in the stream
    KeyedTuple tuple;
  };

  static std::size_t bytes_of(const Kept& kept) { return kept.tuple.bytes() + sizeof(Kept); }

  bool is_before(const Kept& a, const Kept& b) const {
    if (a.prefix != b.prefix) return a.prefix < b.prefix;
    const auto order = order_.compare_further(a.tuple, b.tuple);
    return order != 0 ? order < 0 : a.number < b.number;
  }

  /// Hands the kept tuples over to a sort: those that were dropped are not among the first ones in any case.
  Status give_up() {
    is_too_large_ = true;
    account_.clear();
    std::ranges::sort(heap_, {}, &Kept::number);
    for (Kept& kept : heap_) A3D_TRY(sorter_.add(std::move(kept.tuple.tuple())));
    heap_.clear();
    return {};
  }

  SortOrder order_;
  std::size_t count_;
  algebra3d::MemoryAccount account_;
  Sorter sorter_;
  std::vector<Kept> heap_;
  std::size_t bytes_ = 0;  // of the heap
  std::uint64_t number_ = 0;
  bool is_too_large_ = false;
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

Result<TupleStreamPtr> sorted(TupleStream& tuples, const std::vector<SortKey>& order, const Context& context) {
  Sorter sorter(order, context);
  A3D_TRY(for_each_tuple(tuples, context, [&](const TuplePtr& tuple) { return sorter.add(tuple); }));
  return sorter.finish();
}

Result<TupleStreamPtr> first_sorted(TupleStream& tuples, const std::vector<SortKey>& order, std::size_t count,
                                    const Context& context) {
  FirstTuples first(order, count, context);
  A3D_TRY(for_each_tuple(tuples, context, [&](const TuplePtr& tuple) { return first.add(tuple); }));
  return first.finish();
}

}  // namespace queries
