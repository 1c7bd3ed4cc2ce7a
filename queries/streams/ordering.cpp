// sortby, sort, rdup, rduph, krdup, krduph: order, and what is equal.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/any_stream.h"
#include "queries/streams/detail/hash_table.h"
#include "queries/streams/detail/key_table.h"
#include "queries/streams/detail/sorting.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {
namespace {

BoundOperator sorting_of_first(const TypeExpr& tuple, const std::vector<SortKey>& order, std::size_t count) {
  return {TypeExpr::stream(tuple),
          [order, count](std::vector<Datum> given, Context& context) -> Result<Datum> {
            A3D_ASSIGN(TupleStreamPtr stream, first_sorted(*given[0].tuples(), order, count, context));
            return Datum{std::move(stream)};
          },
          SortsTuples{order, {}, {}, count}, "keeps the first " + std::to_string(count)};
}

BoundOperator without_sorting(const TypeExpr& tuple) {
  AttributeSources sources;
  for (std::size_t index = 0; index < tuple.attributes().size(); ++index) sources.push_back({false, index});
  return {TypeExpr::stream(tuple), [](std::vector<Datum> given, Context&) -> Result<Datum> { return given[0]; },
          MakesTuples{std::move(sources)}, "left out: the groups are put in order"};
}

BoundOperator sorting(const TypeExpr& tuple, const std::vector<SortKey>& order) {
  return {TypeExpr::stream(tuple),
          [order](std::vector<Datum> given, Context& context) -> Result<Datum> {
            A3D_ASSIGN(TupleStreamPtr stream, sorted(*given[0].tuples(), order, context));
            return Datum{std::move(stream)};
          },
          SortsTuples{order, [tuple] { return without_sorting(tuple); },
                      [tuple, order](std::size_t count) { return sorting_of_first(tuple, order, count); }}};
}

Result<BoundOperator> map_sortby(std::span<const ArgumentType> arguments) {
  const MappingCheck check("sortby", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const auto attributes, check.attributes(1, tuple));
  if (attributes.empty()) return check.error("expected at least one attribute");
  std::vector<SortKey> order;
  for (std::size_t i = 0; i < attributes.size(); ++i) order.push_back({attributes[i], check[1].modifiers[i] == "desc"});
  return sorting(tuple, order);
}

Result<BoundOperator> map_sort(std::span<const ArgumentType> arguments) {
  A3D_ASSIGN(const TypeExpr tuple, MappingCheck("sort", arguments).stream(0));
  return sorting(tuple, ascending(all_attributes(tuple)));
}

/// The elements whose keys `is_new` takes for new. `keys_of(element)` gives a Result of loaded values.
template <typename Stream, typename KeysOf, typename IsNew>
Datum without_duplicates(const std::shared_ptr<Stream>& stream, KeysOf keys_of, IsNew is_new, const Context& context) {
  return Datum{make_stream_of<Stream>(
      [stream, keys_of, is_new = std::move(is_new), &context, step = 0U]() mutable -> Result<ElementOf<Stream>> {
        while (true) {
          if (++step % 1024 == 0) A3D_TRY(context.check_cancelled());
          A3D_ASSIGN(ElementOf<Stream> next, stream->next());
          if (!next) return next;
          A3D_ASSIGN(std::vector<Value> keys, keys_of(next));
          if (is_new(std::move(keys))) return next;
        }
      })};
}

/// Takes what differs from the one before for new.
class DiffersFromLast {
 public:
  bool operator()(std::vector<Value> keys) {
    const bool is_new = !last_ || compare_keys(*last_, keys) != 0;
    if (is_new) last_ = std::move(keys);
    return is_new;
  }

 private:
  std::optional<std::vector<Value>> last_;
};

Result<BoundOperator> map_krdup(std::span<const ArgumentType> arguments) {
  const MappingCheck check("krdup", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const auto keys, check.distinct_attributes(1, tuple));
  return BoundOperator{TypeExpr::stream(tuple),
                       [keys](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         const auto keys_of = [keys](const TuplePtr& next) { return loaded_keys(*next, keys); };
                         return without_duplicates(given[0].tuples(), keys_of, DiffersFromLast(), context);
                       },
                       SelectsByAttributes{keys}};
}

/// The tuples of a buffer, numbered from 1 by a further attribute.
TupleStreamPtr numbered(const TupleBuffer& tuples) {
  return make_stream([scan = tuples.scan(), number = TupleId{0}]() mutable -> Result<TuplePtr> {
    A3D_ASSIGN(const TuplePtr next, scan->next());
    if (next == nullptr) return next;
    Tuple result = *next;
    result.attributes.push_back(id_value(++number));
    return TuplePtr(std::make_shared<const Tuple>(std::move(result)));
  });
}

/// Without the last attribute.
TupleStreamPtr without_number(TupleStreamPtr tuples) {
  return make_stream([tuples = std::move(tuples)]() -> Result<TuplePtr> {
    A3D_ASSIGN(const TuplePtr next, tuples->next());
    if (next == nullptr) return next;
    Tuple result = *next;
    result.attributes.pop_back();
    return TuplePtr(std::make_shared<const Tuple>(std::move(result)));
  });
}

/// The first tuple of each key, in the order of the buffer: sorted by the keys, thinned out, and sorted back.
Result<TupleStreamPtr> first_by_sorting(const TupleBuffer& tuples, const std::vector<std::size_t>& keys,
                                        const Context& context) {
  if (tuples.is_empty()) return tuples.scan();
  A3D_ASSIGN(const TuplePtr any, tuples.scan()->next());
  A3D_ASSIGN(const TupleStreamPtr by_keys, sorted(*numbered(tuples), ascending(keys), context));
  const auto keys_of = [keys](const TuplePtr& next) { return loaded_keys(*next, keys); };
  const Datum first = without_duplicates(by_keys, keys_of, DiffersFromLast(), context);
  A3D_ASSIGN(TupleStreamPtr result, sorted(*first.tuples(), ascending({any->attributes.size()}), context));
  return without_number(std::move(result));
}

// Once the memory is full of keys, tuples with other keys are put aside until the stream has ended: all of them come
// after those that went out, so that every tuple keeps its place in the order.
class FirstOfEachKey final : public TupleStream {
 public:
  FirstOfEachKey(TupleStreamPtr tuples, std::vector<std::size_t> keys, bool has_column_keys, const Context& context)
      : tuples_(std::move(tuples)),
        keys_(std::move(keys)),
        context_(context),
        has_batches_(has_column_keys && tuples_->has_batches()),
        seen_(context),
        table_(keys_, 0, context),
        put_aside_(context) {}

  Result<TuplePtr> next() override {
    while (!has_ended_) {
      if (++steps_ % 1024 == 0) A3D_TRY(context_.check_cancelled());
      A3D_ASSIGN(TuplePtr next, tuples_->next());
      if (next == nullptr) {
        A3D_TRY(go_on_aside());
        break;
      }
      A3D_ASSIGN(std::vector<Value> keys, loaded_keys(*next, keys_));
      const SeenKeys::Answer answer = seen_.add(std::move(keys));
      if (answer == SeenKeys::Answer::is_new) return next;
      if (answer == SeenKeys::Answer::no_room) A3D_TRY(put_aside_.add(std::move(next)));
    }
    return tuples_->next();
  }

  bool has_batches() const override { return has_batches_; }
  Result<const Batch*> next_batch(std::size_t most) override {
    while (!has_ended_) {
      A3D_TRY(context_.check_cancelled());
      A3D_ASSIGN(const Batch* const batch, tuples_->next_batch(most));
      if (batch == nullptr) {
        A3D_TRY(go_on_aside());
        break;
      }
      A3D_TRY(select_new(*batch));
      if (batch_.rows.count > 0) return &batch_;
    }
    return aside_->next(most);
  }

 private:
  Status select_new(const Batch& batch) {
    std::size_t known = table_.size();
    table_.find_numbers(batch, numbers_);
    new_rows_.clear();
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      const std::size_t row = batch.rows[i];
      if (numbers_[i] == KeyTable::kNoRoom) A3D_TRY(put_aside_.add(tuple_of(batch, row)));
      if (numbers_[i] != known) continue;
      ++known;
      new_rows_.push_back(static_cast<std::uint32_t>(row));
    }
    batch_ = batch;
    batch_.rows = {new_rows_.data(), new_rows_.size()};
    return {};
  }

  Status go_on_aside() {
    has_ended_ = true;
    seen_.clear();
    table_.clear();
    A3D_ASSIGN(tuples_, first_by_sorting(put_aside_, keys_, context_));
    aside_.emplace(*tuples_);
    return {};
  }

  TupleStreamPtr tuples_;
  std::vector<std::size_t> keys_;
  const Context& context_;
  const bool has_batches_;
  SeenKeys seen_;   // tuple by tuple
  KeyTable table_;  // in batches
  std::vector<std::uint32_t> numbers_, new_rows_;
  Batch batch_;
  TupleBuffer put_aside_;
  std::optional<BatchReader> aside_;
  bool has_ended_ = false;
  std::uint32_t steps_ = 0;
};

/// Whether all these attributes have types that stand in columns.
bool stand_in_columns(const TypeExpr& tuple, const std::vector<std::size_t>& attributes) {
  return std::ranges::all_of(attributes, [&](std::size_t attribute) {
    return type_in_columns(tuple.attributes()[attribute].type) != nullptr;
  });
}

BoundOperator first_of_each_key(const TypeExpr& tuple, const std::vector<std::size_t>& keys) {
  const bool has_column_keys = stand_in_columns(tuple, keys);
  return {TypeExpr::stream(tuple),
          [keys, has_column_keys](std::vector<Datum> given, Context& context) -> Result<Datum> {
            return Datum{
                TupleStreamPtr(std::make_shared<FirstOfEachKey>(given[0].tuples(), keys, has_column_keys, context))};
          },
          SelectsByAttributes{keys}};
}

Result<BoundOperator> map_krduph(std::span<const ArgumentType> arguments) {
  const MappingCheck check("krduph", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const auto keys, check.distinct_attributes(1, tuple));
  return first_of_each_key(tuple, keys);
}

// The number of buckets that SECONDO takes means nothing here.
Result<BoundOperator> map_rduph(std::span<const ArgumentType> arguments) {
  const MappingCheck check("rduph", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_TRY(check.argument_count(1, 2));
  if (check.count() == 2) A3D_TRY(check.type(1, "int"));
  return first_of_each_key(tuple, all_attributes(tuple));
}

/// `sort rdup` in one: the different tuples, sorted.
BoundOperator distinct_tuples(const TypeExpr& tuple, const std::vector<SortKey>& order) {
  const std::vector<std::size_t> all = all_attributes(tuple);
  return {TypeExpr::stream(tuple),
          [all, order, in_columns = stand_in_columns(tuple, all)](const std::vector<Datum>& given,
                                                                  Context& context) -> Result<Datum> {
            FirstOfEachKey different(given[0].tuples(), all, in_columns, context);
            A3D_ASSIGN(TupleStreamPtr stream, sorted(different, order, context));
            return Datum{std::move(stream)};
          },
          UsesAttributes{all}, "by a hash table"};
}

Result<BoundOperator> map_rdup(std::span<const ArgumentType> arguments) {
  A3D_ASSIGN(const TypeExpr element, MappingCheck("rdup", arguments).any_stream(0));
  return BoundOperator{
      TypeExpr::stream(element),
      [](std::vector<Datum> given, Context& context) -> Result<Datum> {
        return visit_stream(given[0], [&](const auto& stream) {
          const auto keys_of = [](const auto& next) { return loaded_values(next); };
          return Result<Datum>(without_duplicates(stream, keys_of, DiffersFromLast(), context));
        });
      },
      RemovesDuplicates{[element](std::vector<SortKey> order) { return distinct_tuples(element, std::move(order)); }}};
}

}  // namespace

void register_ordering(algebra3d::OperatorGroup& group) {
  const std::string pairs = "[const rel(tuple([A: int, B: int])) value ((2 1) (undefined 5) (2 1) (1 7) (2 0))] feed ";
  group.add({
      .name = "sortby",
      .syntax = "_ sortby[keys]",
      .doc = "The tuples in the order of the named attributes, ascending unless `desc` follows; undefined comes first.",
      .detail = "Tuples with equal keys keep their order.",
      .stream = stream_operator(map_sortby),
      .signatures = {"(stream(tuple) ((NAME asc|desc) ...)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 3) transformstream sortby[Elem desc] consume", "((3) (2) (1))"},
                         {"[const rel(tuple([A: int])) value ((2) (undefined) (1))] feed sortby[A] consume",
                          "((undefined) (1) (2))"}},
      .query_errors = {{"query intstream(1, 3) transformstream sortby[Name] count",
                        "sortby: unknown attribute 'Name'"}},
  });
  group.add({
      .name = "sort",
      .syntax = "_ sort",
      .doc = "The tuples in the order of all their attributes, from the first to the last; undefined comes first.",
      .stream = stream_operator(map_sort),
      .signatures = {"(stream(tuple)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{pairs + "sort consume", "((undefined 5) (1 7) (2 0) (2 1) (2 1))"}},
      .query_errors = {{"query 5 sort", "sort: expected a stream of tuples, got int"},
                       {"query intstream(1, 3) sort count",
                        "sort: expected a stream of tuples (write `transformstream` after the stream of values)"}},
  });
  group.add({
      .name = "rdup",
      .syntax = "_ rdup",
      .doc = "The elements of a stream without those that equal their predecessor.",
      .detail = "After `sort` the result has no duplicates. Undefined equals undefined.",
      .cost = algebra3d::Cost::linear,
      .stream = stream_operator(map_rdup),
      .signatures = {"(stream(tuple)) -> stream(tuple)", "(stream(DATA)) -> stream(DATA)"},
      .handles_undefined = true,
      .query_examples = {{pairs + "sort rdup consume", "((undefined 5) (1 7) (2 0) (2 1))"},
                         {pairs + "projecttransformstream[A] rdup count", "5"}},
      .query_errors = {{"query 5 rdup", "rdup: expected a stream, got int"}},
  });
  group.add({
      .name = "rduph",
      .syntax = "_ rduph[...]",
      .doc = "The tuples without those that equal any earlier tuple; the stream need not be sorted.",
      .detail = "The first of equal tuples stays. Undefined equals undefined. A number of buckets in brackets, as in "
                "SECONDO, is accepted and ignored.",
      .cost = algebra3d::Cost::linear,
      .stream = stream_operator(map_rduph),
      .signatures = {"(stream(tuple)) -> stream(tuple)", "(stream(tuple) int) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{pairs + "rduph consume", "((2 1) (undefined 5) (1 7) (2 0))"},
                         {pairs + "project[A] rduph[997] consume", "((2) (undefined) (1))"}},
      .query_errors = {{"query 5 rduph", "rduph: expected a stream of tuples, got int"},
                       {"query " + pairs + "rduph[TRUE] count", "rduph: expected int, got bool"}},
  });
  group.add({
      .name = "krdup",
      .syntax = "_ krdup[attributes]",
      .doc = "The tuples without those whose named attributes equal those of their predecessor.",
      .detail = "The first tuple of each run stays. Undefined equals undefined.",
      .cost = algebra3d::Cost::linear,
      .stream = stream_operator(map_krdup),
      .signatures = {"(stream(tuple) NAMES) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{pairs + "sortby[A] krdup[A] consume", "((undefined 5) (1 7) (2 1))"},
                         {pairs + "krdup[A] count", "5"}},
      .query_errors = {{"query " + pairs + "krdup[C] count", "krdup: unknown attribute 'C'"},
                       {"query " + pairs + "krdup[A, A] count", "krdup: duplicate attribute name 'A'"}},
  });
  group.add({
      .name = "krduph",
      .syntax = "_ krduph[attributes]",
      .doc = "The tuples without those whose named attributes equal those of any earlier tuple; the stream need not "
             "be sorted.",
      .detail = "The first tuple of each key stays. Undefined equals undefined.",
      .cost = algebra3d::Cost::linear,
      .stream = stream_operator(map_krduph),
      .signatures = {"(stream(tuple) NAMES) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{pairs + "krduph[A] consume", "((2 1) (undefined 5) (1 7))"},
                         {pairs + "krduph[A, B] count", "4"}},
      .query_errors = {{"query " + pairs + "krduph[C] count", "krduph: unknown attribute 'C'"}},
  });
}

}  // namespace queries
