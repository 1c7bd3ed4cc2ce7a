#include "queries/streams/value_operators.h"

#include <algorithm>

#include "algebra3d/operators/registry/aggregate.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/rows.h"
#include "base/propagate.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

using algebra3d::Aggregation;
using algebra3d::Operator;
using algebra3d::OperatorKind;
using algebra3d::Overload;
using algebra3d::Registry;
using algebra3d::ResolvedCall;
using algebra3d::Row;
using algebra3d::RowSource;
using algebra3d::RowSourcePtr;

constexpr std::uint32_t kRowsBetweenChecks = 1024;

/// "int or real"
std::string parameter_types(const Operator& op) {
  std::vector<std::string> names;
  for (const Overload& overload : op.overloads) names.emplace_back(overload.parameters.front().type->name());
  return algebra3d::enumerate(names);
}

Result<Datum> aggregated(const ResolvedCall& call, const TupleStreamPtr& tuples, std::size_t attribute,
                         Context& context) {
  Aggregation aggregation(call);
  if (tuples->has_batches())
    A3D_TRY(for_each_batch(*tuples, context, [&](const Batch& batch) {
      return aggregation.step_rows(*batch.columns[attribute], batch.rows, context);
    }));
  else
    A3D_TRY(for_each_tuple(*tuples, context, [&](const TuplePtr& tuple) {
      return aggregation.step(tuple->attributes[attribute], context);
    }));
  A3D_ASSIGN(Value result, aggregation.finish(context));
  return Datum{std::move(result)};
}

// The overload of an aggregate for values of exactly that type; null if there is none.
const Overload* overload_for_values(const Registry& registry, const Operator& op, const TypeExpr& type) {
  if (type.is_nested_relation()) return registry.overload_for(op, type);
  const auto found = std::ranges::find_if(
      op.overloads, [&](const Overload& each) { return type.is(each.parameters.front().type->name()); });
  return found == op.overloads.end() ? nullptr : &*found;
}

Result<BoundOperator> bind_aggregate(const Registry& registry, const Operator& op,
                                     std::span<const ArgumentType> arguments) {
  const MappingCheck check(op.name, arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const std::size_t attribute, check.attribute(1, tuple));
  const TypeExpr& type = tuple.attributes()[attribute].type;
  const Overload* const overload = overload_for_values(registry, op, type);
  if (overload == nullptr) return check.expected("an attribute of type " + parameter_types(op), type);
  return BoundOperator{
      overload->result_type(),
      [call = ResolvedCall{&op, overload}, attribute](const std::vector<Datum>& given, Context& running) {
        return aggregated(call, given[0].tuples(), attribute, running);
      },
      AggregatesAttribute{ResolvedCall{&op, overload}, attribute}};
}

/// The next row; nothing at the end. Interruptible.
Result<std::optional<Row>> next_row(RowSource& rows, std::uint32_t& step, Context& context) {
  if (++step % kRowsBetweenChecks == 0) A3D_TRY(context.check_cancelled());
  return rows.next(context);
}

class TuplesOfRows final : public TupleStream {
 public:
  TuplesOfRows(RowSourcePtr rows, Context& context) : rows_(std::move(rows)), context_(context) {}
  Result<TuplePtr> next() override {
    A3D_ASSIGN(std::optional<Row> row, next_row(*rows_, step_, context_));
    return row ? std::make_shared<const Tuple>(Tuple{*std::move(row)}) : TuplePtr();
  }
  std::optional<std::uint64_t> known_count() const override { return rows_->count(); }

 private:
  RowSourcePtr rows_;
  Context& context_;
  std::uint32_t step_ = 0;
};

ValueStreamPtr values_of_rows(std::shared_ptr<RowSource> rows, Context& context) {
  return make_value_stream([rows = std::move(rows), &context, step = 0U]() mutable -> Result<std::optional<Value>> {
    A3D_ASSIGN(std::optional<Row> row, next_row(*rows, step, context));
    return row ? std::optional(std::move(row->front())) : std::nullopt;
  });
}

}  // namespace

bool takes_streams(const Operator& op) {
  return op.kind() == OperatorKind::relational || op.kind() == OperatorKind::aggregate;
}

Result<BoundOperator> bind_operator(const Registry& registry, const Operator& op,
                                    std::span<const ArgumentType> arguments, Context& context) {
  if (op.kind() == OperatorKind::aggregate) return bind_aggregate(registry, op, arguments);
  return static_cast<const StreamOperator&>(*op.stream).bind(arguments, context);
}

Datum stream_of(RowSourcePtr rows, const Overload& overload, Context& context) {
  if (overload.gives_elements) return Datum{values_of_rows(std::move(rows), context)};
  return Datum{std::make_shared<TuplesOfRows>(std::move(rows), context)};
}

}  // namespace queries
