// filter, head, tail, nth, some, exist: which elements of a stream go on.
#include <algorithm>
#include <deque>
#include <numeric>
#include <optional>
#include <random>
#include <utility>

#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/batch_buffer.h"
#include "queries/streams/detail/any_stream.h"
#include "queries/streams/detail/column_streams.h"
#include "queries/streams/detail/element_buffer.h"
#include "queries/streams/detail/kept_elements.h"

namespace queries {
namespace {

ValueStreamPtr selected_values(ValueStreamPtr values, std::shared_ptr<const Function> predicate,
                               const Context& context) {
  return make_value_stream([values = std::move(values), predicate = std::move(predicate), &context,
                            step = 0U]() mutable -> Result<std::optional<Value>> {
    while (true) {
      A3D_ASSIGN(std::optional<Value> next, values->next());
      if (!next) return next;
      const Datum argument{*next};
      A3D_ASSIGN(const Value holds, predicate->call_for_value({&argument, 1}));
      if (is_true(holds)) return next;
      if (++step % 1024 == 0) A3D_TRY(context.check_cancelled());
    }
  });
}

Result<BoundOperator> map_filter(std::span<const ArgumentType> arguments) {
  const MappingCheck check("filter", arguments);
  A3D_ASSIGN(const TypeExpr element, check.any_stream(0));
  A3D_TRY(check.function(1, {element}, "bool"));
  return BoundOperator{TypeExpr::stream(element),
                       [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         const auto& predicate = given[1].function_ptr();
                         if (const auto* values = std::get_if<ValueStreamPtr>(&given[0].content))
                           return Datum{selected_values(*values, predicate, context)};
                         return Datum{selected_tuples(given[0].tuples(), predicate, context)};
                       },
                       SelectsElements{}};
}

// A number of elements: none for an undefined or negative one.
std::size_t element_count(const Datum& datum) {
  const Value& value = datum.value();
  return value.is_defined() ? static_cast<std::size_t>(std::max<std::int64_t>(0, value.get<std::int64_t>())) : 0;
}

Result<BoundOperator> map_head(std::span<const ArgumentType> arguments) {
  const MappingCheck check("head", arguments);
  A3D_ASSIGN(const TypeExpr element, check.any_stream(0));
  A3D_TRY(check.type(1, "int"));
  return BoundOperator{
      TypeExpr::stream(element),
      [](std::vector<Datum> given, Context&) -> Result<Datum> {
        const std::size_t count = element_count(given[1]);
        if (const auto* values = std::get_if<ValueStreamPtr>(&given[0].content))
          return Datum{make_value_stream([values = *values, left = count]() mutable -> Result<std::optional<Value>> {
            if (left == 0) return std::optional<Value>();
            --left;
            return values->next();
          })};
        return Datum{first_tuples(given[0].tuples(), count)};
      },
      TakesFirst{}};
}

/// The last elements that were added. Two buffers: when the newer one holds as many as are wanted, the older one goes.
template <typename Stream>
class LastInBuffers {
 public:
  LastInBuffers(std::size_t count, const Context& context)
      : wanted_(count), context_(context), older_(context), newer_(context) {}

  Status add(const ElementOf<Stream>& element) {
    if (wanted_ == 0) return {};
    if (newer_.size() == wanted_) older_ = std::exchange(newer_, ElementBuffer<Stream>(context_));
    return newer_.add(element);
  }
  std::shared_ptr<Stream> all() const {
    const std::size_t wanted_of_older = std::min(wanted_ - newer_.size(), older_.size());
    return one_after_the_other(older_.scan(older_.size() - wanted_of_older), newer_.scan());
  }

 private:
  std::size_t wanted_;
  const Context& context_;
  ElementBuffer<Stream> older_, newer_;
};

/// The last tuples of a stream, in columns, as batches.
class LastBatches {
 public:
  LastBatches(std::size_t count, const Context& context) : wanted_(count), account_(context.memory) {}

  /// False if the work memory is exhausted: then nothing was added.
  bool add(const Batch& batch) {
    if (wanted_ == 0) return true;
    KeptBatch kept(batch);
    if (kept.bytes() > spare_bytes_ && !account_.take(kept.bytes() - spare_bytes_)) return false;
    spare_bytes_ -= std::min(spare_bytes_, kept.bytes());
    size_ += batch.rows.count;
    batches_.push_back(std::move(kept));
    for (; size_ - batches_.front().batch().size >= wanted_; batches_.pop_front()) {
      size_ -= batches_.front().batch().size;
      spare_bytes_ += batches_.front().bytes();
    }
    return true;
  }
  /// Calls `visit` for the tuples so far.
  template <typename Visit>
  Status for_each(Visit visit) const {
    for (const KeptBatch& kept : batches_)
      for (std::size_t row = 0; row < kept.batch().size; ++row) A3D_TRY(visit(tuple_of(kept.batch(), row)));
    return {};
  }
  /// The next of the last tuples; null at the end. To be called when all have been added.
  const Batch* next(std::size_t most) {
    if (size_ > wanted_) skipped_ += std::exchange(size_, wanted_) - wanted_;
    while (!batches_.empty() && skipped_ == batches_.front().batch().size) {
      skipped_ = 0;
      batches_.pop_front();
    }
    if (batches_.empty()) return nullptr;
    part_ = batches_.front().batch();
    rows_.resize(std::min(most, part_.size - skipped_));
    std::iota(rows_.begin(), rows_.end(), static_cast<std::uint32_t>(skipped_));
    skipped_ += rows_.size();
    part_.rows = {rows_.data(), rows_.size()};
    return &part_;
  }

 private:
  std::size_t wanted_;
  algebra3d::MemoryAccount account_;
  std::size_t spare_bytes_ = 0;  // taken, and free again
  std::deque<KeptBatch> batches_;
  std::size_t size_ = 0;     // of all batches
  std::size_t skipped_ = 0;  // rows of the first one
  Batch part_;
  std::vector<std::uint32_t> rows_;
};

class LastTuples final : public TupleStream {
 public:
  explicit LastTuples(LastBatches last) : last_(std::move(last)) {}
  Result<TuplePtr> next() override {
    const Batch* const batch = last_.next(1);
    return batch == nullptr ? TuplePtr() : tuple_of(*batch, batch->rows[0]);
  }
  bool has_batches() const override { return true; }
  Result<const Batch*> next_batch(std::size_t most) override { return last_.next(most); }

 private:
  LastBatches last_;
};

/// As `last_elements`, of a stream with batches.
Result<TupleStreamPtr> last_tuples(TupleStream& stream, std::size_t count, const Context& context) {
  std::optional<LastBatches> in_columns(std::in_place, count, context);
  std::optional<LastInBuffers<TupleStream>> in_rows;
  const auto add = [&](const TuplePtr& tuple) { return in_rows->add(tuple); };
  const auto add_batch = [&](const Batch& batch) -> Status {
    if (in_columns && in_columns->add(batch)) return {};
    if (in_columns) {
      in_rows.emplace(count, context);
      A3D_TRY(in_columns->for_each(add));
      in_columns.reset();
    }
    for (std::size_t i = 0; i < batch.rows.count; ++i) A3D_TRY(add(tuple_of(batch, batch.rows[i])));
    return {};
  };
  A3D_TRY(for_each_batch(stream, context, add_batch));
  if (in_rows) return in_rows->all();
  return TupleStreamPtr(std::make_shared<LastTuples>(*std::move(in_columns)));
}

template <typename Stream>
Result<std::shared_ptr<Stream>> last_elements(Stream& stream, std::size_t count, const Context& context) {
  if constexpr (std::is_same_v<Stream, TupleStream>)
    if (stream.has_batches()) return last_tuples(stream, count, context);
  LastInBuffers<Stream> last(count, context);
  A3D_TRY(for_each_element(stream, context, [&](const auto& element) { return last.add(element); }));
  return last.all();
}

/// The elements of a stream, the last one first. They stand in memory; error if they are too many for it.
template <typename Stream>
Result<std::shared_ptr<Stream>> reversed(Stream& stream, const Context& context) {
  KeptElements<Stream> kept("tail", context);
  A3D_TRY(for_each_element(stream, context, [&](const auto& element) { return kept.add(element); }));
  return make_stream_of<Stream>([kept = std::move(kept)]() mutable -> Result<ElementOf<Stream>> {
    if (kept.elements().empty()) return ElementOf<Stream>();
    ElementOf<Stream> next = std::move(kept.elements().back());
    kept.elements().pop_back();
    return next;
  });
}

Result<BoundOperator> map_tail(std::span<const ArgumentType> arguments) {
  const MappingCheck check("tail", arguments);
  A3D_ASSIGN(const TypeExpr element, check.any_stream(0));
  A3D_TRY(check.argument_count(2, 3));
  A3D_TRY(check.type(1, "int"));
  if (check.count() == 3) A3D_TRY(check.type(2, "bool"));
  return BoundOperator{TypeExpr::stream(element),
                       [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         const bool keep_order =
                             given.size() < 3 || !given[2].value().is_defined() || given[2].value().get<bool>();
                         return visit_stream(given[0], [&](const auto& stream) -> Result<Datum> {
                           A3D_ASSIGN(auto last, last_elements(*stream, element_count(given[1]), context));
                           if (keep_order) return Datum{std::move(last)};
                           A3D_ASSIGN(auto backwards, reversed(*last, context));
                           return Datum{std::move(backwards)};
                         });
                       },
                       TakesLast{}};
}

/// Elements n, 2n, 3n and so on, or element n alone.
template <typename Stream>
Datum every_nth(const std::shared_ptr<Stream>& stream, std::size_t distance, bool once, const Context& context) {
  return Datum{make_stream_of<Stream>([stream, distance, once, &context, is_done = distance == 0,
                                       position = std::uint64_t{0}]() mutable -> Result<ElementOf<Stream>> {
    while (!is_done) {
      A3D_ASSIGN(ElementOf<Stream> next, stream->next());
      if (!next) break;
      if (++position % 1024 == 0) A3D_TRY(context.check_cancelled());
      if (position % distance != 0) continue;
      is_done = once;
      return next;
    }
    return ElementOf<Stream>();
  })};
}

Result<BoundOperator> map_nth(std::span<const ArgumentType> arguments) {
  const MappingCheck check("nth", arguments);
  A3D_ASSIGN(const TypeExpr element, check.any_stream(0));
  A3D_TRY(check.argument_count(2, 3));
  A3D_TRY(check.type(1, "int"));
  if (check.count() == 3) A3D_TRY(check.type(2, "bool"));
  return BoundOperator{TypeExpr::stream(element), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         const bool once = given.size() == 3 && is_true(given[2].value());
                         return visit_stream(given[0], [&](const auto& stream) {
                           return Result<Datum>(every_nth(stream, element_count(given[1]), once, context));
                         });
                       }};
}

// Reservoir sampling, with a generator of its own whose numbers are the same everywhere, so that the same stream gives
// the same elements. Source: [vitter1985], algorithm R. The remainder of a 64-bit number is as good as uniform here.
// The reservoir holds the numbers of elements; every element that ever had a place in it is put aside.
template <typename Stream>
Result<Datum> drawn(Stream& stream, std::size_t count, const Context& context) {
  std::mt19937_64 generator;  // NOLINT(cert-msc32-c,cert-msc51-cpp): the fixed seed is the point
  std::vector<std::uint64_t> sample;
  ElementBuffer<Stream> put_aside(context);
  std::vector<std::uint64_t> numbers;  // of what was put aside
  std::uint64_t seen = 0;
  A3D_TRY(for_each_element(stream, context, [&](const auto& element) -> Status {
    const std::uint64_t number = seen++;
    const std::uint64_t place = number < count ? number : generator() % seen;
    if (place >= count) return {};
    if (place == sample.size()) sample.emplace_back();
    sample[place] = number;
    numbers.push_back(number);
    return put_aside.add(element);
  }));
  std::ranges::sort(sample);
  return Datum{make_stream_of<Stream>([sample = std::move(sample), numbers = std::move(numbers),
                                       scan = put_aside.scan(), wanted = std::size_t{0},
                                       position = std::size_t{0}]() mutable -> Result<ElementOf<Stream>> {
    while (wanted < sample.size()) {
      A3D_ASSIGN(ElementOf<Stream> next, scan->next());
      if (numbers[position++] != sample[wanted]) continue;
      ++wanted;
      return next;
    }
    return ElementOf<Stream>();
  })};
}

Result<BoundOperator> map_some(std::span<const ArgumentType> arguments) {
  const MappingCheck check("some", arguments);
  A3D_ASSIGN(const TypeExpr element, check.any_stream(0));
  A3D_TRY(check.type(1, "int"));
  return BoundOperator{TypeExpr::stream(element), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         return visit_stream(given[0], [&](const auto& stream) {
                           return drawn(*stream, element_count(given[1]), context);
                         });
                       }};
}

Result<BoundOperator> map_exist(std::span<const ArgumentType> arguments) {
  A3D_TRY(MappingCheck("exist", arguments).any_stream(0));
  return BoundOperator{"bool", [](std::vector<Datum> given, Context&) -> Result<Datum> {
                         return visit_stream(given[0], [](const auto& stream) -> Result<Datum> {
                           A3D_ASSIGN(const auto first, stream->next());
                           return Datum{Value::of<bool>(static_cast<bool>(first))};
                         });
                       }};
}

}  // namespace

void register_selection(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "filter",
      .syntax = "_ filter[fun(STREAMELEM)]",
      .doc = "The elements of a stream for which the predicate is a defined TRUE.",
      .detail = "In a stream of tuples `.A` is an attribute, in a stream of values `.` the value.",
      .stream = stream_operator(map_filter),
      .signatures = {"(stream(tuple) (map tuple bool)) -> stream(tuple)",
                     "(stream(DATA) (map DATA bool)) -> "
                     "stream(DATA)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 10) transformstream filter[.Elem > 8] consume", "((9) (10))"},
                         {"intstream(1, 10) filter[. mod 3 = 0] count", "3"},
                         {"intstream(1, 3) transformstream filter[[const bool value undefined]] count", "0"}},
      .query_errors = {{"query intstream(1, 3) transformstream filter[.Elem] count",
                        "filter: expected a function that gives bool, got int"},
                       {"query 5 filter[TRUE]", "filter: expected a stream as operand 1, got int"}},
  });
  group.add({
      .name = "head",
      .syntax = "_ head[_]",
      .doc = "The first n elements of a stream.",
      .detail = "None for n below 1 or undefined.",
      .stream = stream_operator(map_head),
      .signatures = {"(stream(tuple) int) -> stream(tuple)", "(stream(DATA) int) -> stream(DATA)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 10) transformstream head[2] consume", "((1) (2))"},
                         {"intstream(1, 10) head[4] count", "4"},
                         {"intstream(1, 10) transformstream head[[const int value undefined]] count", "0"}},
      .query_errors = {{"query intstream(1, 3) transformstream head[1.5] count", "head: expected int, got real"},
                       {"query 5 head[1]", "head: expected a stream, got int"}},
  });
  group.add({
      .name = "tail",
      .syntax = "_ tail[_ ...]",
      .doc = "The last n elements of a stream, in their order or, with FALSE as the last argument, the last one first.",
      .detail = "None for n below 1 or undefined.",
      .stream = stream_operator(map_tail),
      .signatures = {"(stream(tuple) int) -> stream(tuple)", "(stream(tuple) int bool) -> stream(tuple)",
                     "(stream(DATA) int) -> stream(DATA)", "(stream(DATA) int bool) -> stream(DATA)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 10) transformstream tail[2] consume", "((9) (10))"},
                         {"intstream(1, 10) tail[2, FALSE] transformstream consume", "((10) (9))"},
                         {"intstream(1, 10) transformstream tail[[const int value undefined]] count", "0"}},
      .query_errors = {{"query intstream(1, 3) transformstream tail[1, 2] count", "tail: expected bool, got int"}},
  });
  group.add({
      .name = "nth",
      .syntax = "_ nth[_ ...]",
      .doc = "Every n-th element of a stream or, with TRUE as the last argument, the n-th element alone.",
      .detail = "None for n below 1 or undefined.",
      .stream = stream_operator(map_nth),
      .signatures = {"(stream(tuple) int) -> stream(tuple)", "(stream(tuple) int bool) -> stream(tuple)",
                     "(stream(DATA) int) -> stream(DATA)", "(stream(DATA) int bool) -> stream(DATA)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 10) transformstream nth[4] consume", "((4) (8))"},
                         {"intstream(1, 10) transformstream nth[4, TRUE] consume", "((4))"},
                         {"intstream(1, 10) nth[[const int value undefined]] count", "0"}},
      .query_errors = {{"query intstream(1, 3) nth[TRUE] count", "nth: expected int, got bool"},
                       {"query intstream(1, 3) nth[1, 2] count", "nth: expected bool, got int"}},
  });
  group.add({
      .name = "some",
      .syntax = "_ some[_]",
      .doc = "A sample of n elements of a stream, or all if there are no more, in their order.",
      .detail =
          "Every element has the same chance, and the same stream always gives the same sample. None for n below 1 "
          "or undefined.",
      .stream = stream_operator(map_some),
      .signatures = {"(stream(tuple) int) -> stream(tuple)", "(stream(DATA) int) -> stream(DATA)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 100) some[7] count", "7"},
                         {"intstream(1, 3) transformstream some[7] consume", "((1) (2) (3))"},
                         {"intstream(1, 10) some[[const int value undefined]] count", "0"}},
      .query_errors = {{"query intstream(1, 3) some[1.5] count", "some: expected int, got real"},
                       {"query 5 some[1] count", "some: expected a stream, got int"}},
  });
  group.add({
      .name = "exist",
      .syntax = "_ exist",
      .doc = "True if a stream has an element.",
      .detail = "Reads no more than the first one.",
      .stream = stream_operator(map_exist),
      .signatures = {"(stream(tuple)) -> bool", "(stream(DATA)) -> bool"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 10) transformstream filter[.Elem > 9] exist", "TRUE"},
                         {"intstream(1, 10) filter[. > 10] exist", "FALSE"},
                         {"[const int value undefined] feed exist", "TRUE"}},
      .query_errors = {{"query 5 exist", "exist: expected a stream, got int"},
                       {"query [const rel(tuple([A: int])) value ()] exist",
                        "exist: expected a stream of tuples (write `feed` after the relation), got (rel"}},
  });
}

}  // namespace queries
