// feed, consume, count: between relations and streams.
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/collection.h"
#include "queries/streams/detail/nested_tuples.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"

namespace queries {
namespace {

/// A stream that notices that the statement was interrupted: the one place where long scans do.
class InterruptibleTuples final : public TupleStream {
 public:
  InterruptibleTuples(TupleStreamPtr tuples, const Context& context) : tuples_(std::move(tuples)), context_(context) {}
  Result<TuplePtr> next() override {
    if (++step_ % 256 == 0) A3D_TRY(context_.check_cancelled());
    return tuples_->next();
  }
  bool has_batches() const override { return tuples_->has_batches(); }
  Result<const Batch*> next_batch(std::size_t most) override {
    A3D_TRY(context_.check_cancelled());
    return tuples_->next_batch(most);
  }
  std::vector<StageCount> stages() const override { return tuples_->stages(); }

 private:
  TupleStreamPtr tuples_;
  const Context& context_;
  std::uint32_t step_ = 0;
};

TupleStreamPtr interruptible(TupleStreamPtr tuples, const Context& context) {
  return std::make_shared<InterruptibleTuples>(std::move(tuples), context);
}

/// How a relation is read.
struct ScanPlan {
  TypeExpr tuple;
  std::optional<std::vector<bool>> read;  ///< by attribute; none: tuple by tuple
  std::vector<AttributeBounds> bounds = {};
};

BoundOperator scan_operator(const ScanPlan& plan) {
  const auto run = [plan](std::vector<Datum> given, Context& context) -> Result<Datum> {
    Relation& relation = *given[0].relation();
    A3D_ASSIGN(TupleStreamPtr tuples, plan.read ? relation.scan_columns(*plan.read, plan.bounds) : relation.scan());
    return Datum{interruptible(std::move(tuples), context)};
  };
  const auto of_attributes = [plan](std::vector<bool> read) {
    return scan_operator({plan.tuple, std::move(read), plan.bounds});
  };
  const auto within = [plan](std::vector<AttributeBounds> bounds) {
    std::vector<bool> all(plan.tuple.attributes().size(), true);
    return scan_operator({plan.tuple, plan.read.value_or(std::move(all)), std::move(bounds)});
  };
  return {TypeExpr::stream(plan.tuple), run, ScansRelation{of_attributes, within},
          plan.read ? text_of_read(plan.tuple, *plan.read) : std::string()};
}

Result<BoundOperator> map_feed(std::span<const ArgumentType> arguments) {
  const MappingCheck check("feed", arguments);
  if (check[0].type.is_relation()) return scan_operator({check[0].type.element(), std::nullopt});
  if (check[0].type.is_nested_relation())
    return BoundOperator{TypeExpr::stream(check[0].type.element()),
                         [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                           A3D_ASSIGN(TupleStreamPtr tuples, tuples_of_nested(given[0].value(), context));
                           return Datum{std::move(tuples)};
                         }};
  if (is_collection(check[0].type))
    return BoundOperator{
        TypeExpr::stream(check[0].type.element()),
        [](std::vector<Datum> given, Context&) -> Result<Datum> { return Datum{elements_of(given[0].value())}; }};
  if (check[0].type.is_stream())
    return BoundOperator{check[0].type,
                         [](std::vector<Datum> given, Context&) -> Result<Datum> { return std::move(given[0]); }};
  if (!is_value_type(check[0].type)) return check.expected("a relation, a stream or a value", check[0].type);
  return BoundOperator{TypeExpr::stream(check[0].type), [](std::vector<Datum> given, Context&) -> Result<Datum> {
                         return Datum{make_value_stream([value = std::optional(given[0].value())]() mutable {
                           return Result<std::optional<Value>>(std::exchange(value, std::nullopt));
                         })};
                       }};
}

// consume and tconsume are two names of one operator: a consumed relation lives as long as the statement, or is stored.
Result<BoundOperator> map_consume(const char* op, std::span<const ArgumentType> arguments) {
  A3D_ASSIGN(const TypeExpr tuple, MappingCheck(op, arguments).stream(0));
  return BoundOperator{TypeExpr::rel(tuple),
                       [tuple](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         A3D_ASSIGN(TupleBuffer tuples, buffered(*given[0].tuples(), context));
                         return Datum{RelationPtr(std::make_shared<MemoryRelation>(tuple, std::move(tuples)))};
                       },
                       CollectsTuples{}};
}

Datum counted(std::int64_t count) {
  return Datum{Value::of(count)};
}

Result<Datum> count_values(ValueStream& values, Context& context) {
  for (std::int64_t count = 0;; ++count) {
    if (count % 1024 == 0) A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const auto value, values.next());
    if (!value) return counted(count);
  }
}

Result<Datum> count_tuples(TupleStream& tuples, Context& context) {
  if (const auto known = tuples.known_count()) return counted(static_cast<std::int64_t>(*known));
  std::int64_t count = 0;
  if (tuples.has_batches())
    A3D_TRY(for_each_batch(tuples, context, [&](const Batch& batch) -> Status {
      return count += static_cast<std::int64_t>(batch.rows.count), Status();
    }));
  else
    A3D_TRY(for_each_tuple(tuples, context, [&](const TuplePtr&) -> Status { return ++count, Status(); }));
  return counted(count);
}

// Known without loading the tuples.
Datum count_nested(const Value& relation) {
  if (!relation.is_defined()) return Datum{Value(algebra3d::TypeOf<std::int64_t>::type())};
  return counted(relation.header().size);
}

Result<BoundOperator> map_count(std::span<const ArgumentType> arguments) {
  const MappingCheck check("count", arguments);
  const TypeExpr& type = check[0].type;
  if (type.is_nested_relation())
    return BoundOperator{
        "int", [](std::vector<Datum> given, Context&) -> Result<Datum> { return count_nested(given[0].value()); }};
  if (!type.is_relation() && !type.is_stream() && !is_collection(type))
    return check.expected("a relation or a stream", type);
  return BoundOperator{"int",
                       [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         if (const auto* relation = std::get_if<RelationPtr>(&given[0].content)) {
                           A3D_ASSIGN(const std::int64_t count, (*relation)->count());
                           return counted(count);
                         }
                         if (const auto* values = std::get_if<ValueStreamPtr>(&given[0].content))
                           return count_values(**values, context);
                         if (const auto* collection = std::get_if<Value>(&given[0].content))
                           return counted(static_cast<std::int64_t>(collection->get<Collection>().elements.size()));
                         return count_tuples(*given[0].tuples(), context);
                       },
                       CountsElements{}};
}

}  // namespace

void register_feeding(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "feed",
      .syntax = "_ feed",
      .doc = "A stream of the tuples of a relation or nested relation, in storage order, of the elements of a "
             "collection, or of a single value; a stream is returned unchanged.",
      .stream = stream_operator(map_feed),
      .signatures = {"(rel(tuple)) -> stream(tuple)", "(arel(tuple)) -> stream(tuple)",
                     "(stream(tuple)) -> stream(tuple)", "(stream(DATA)) -> stream(DATA)", "(DATA) -> stream(DATA)",
                     "(set(DATA)) -> stream(DATA)", "(multiset(DATA)) -> stream(DATA)",
                     "(vector(DATA)) -> stream(DATA)"},
      .handles_undefined = true,
      .query_examples = {{"[const rel(tuple([A: int])) value ((1) (2))] feed consume", "((1) (2))"},
                         {"5 feed count", "1"},
                         {"intstream(1, 3) feed count", "3"},
                         {"[const int value undefined] feed count", "1"}},
      .query_errors = {{"query (fun(x: int) x) feed count",
                        "feed: expected a relation, a stream or a value, got (map int int)"}},
  });
  group.add({
      .name = "consume",
      .syntax = "_ consume",
      .doc = "The relation of all tuples of a stream.",
      .stream = stream_operator([](auto arguments) { return map_consume("consume", arguments); }),
      .signatures = {"(stream(tuple)) -> rel(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 3) transformstream consume", "((1) (2) (3))"},
                         {"[const int value undefined] feed transformstream consume", "((undefined))"}},
      .query_errors = {{"query 5 consume", "consume: expected a stream of tuples, got int"}},
  });
  group.add({
      .name = "tconsume",
      .syntax = "_ tconsume",
      .doc = "The relation of all tuples of a stream, in memory: another name of consume.",
      .stream = stream_operator([](auto arguments) { return map_consume("tconsume", arguments); }),
      .signatures = {"(stream(tuple)) -> rel(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 3) transformstream tconsume feed filter[.Elem > 1] tconsume", "((2) (3))"},
                         {"[const int value undefined] feed transformstream tconsume", "((undefined))"}},
      .query_errors = {{"query 5 tconsume", "tconsume: expected a stream of tuples, got int"}},
  });
  group.add({
      .name = "count",
      .syntax = "_ count",
      .doc = "The number of tuples of a relation or nested relation, or of elements of a stream or collection.",
      .stream = stream_operator(map_count),
      .signatures = {"(rel(tuple)) -> int", "(arel(tuple)) -> int", "(stream(tuple)) -> int", "(stream(DATA)) -> int",
                     "(set(DATA)) -> int", "(multiset(DATA)) -> int", "(vector(DATA)) -> int"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 10) count", "10"},
                         {"[const rel(tuple([A: int])) value ()] count", "0"},
                         {"[const int value undefined] feed count", "1"}},
      .query_errors = {{"query 5 count", "count: expected a relation or a stream, got int"}},
  });
}

}  // namespace queries
