// product, symmjoin, loopjoin, loopsel: pairs of tuples by nested loops.
#include <optional>
#include <string>

#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/pairs.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

std::string text_of(const std::optional<JoinKeys>& keys, const JoinTypes& types) {
  if (!keys) return {};
  return "by a hash table of " + types.right.attributes()[keys->right].name + " for " +
         types.left.attributes()[keys->left].name;
}

/// `product` and `symmjoin`, whose function is at place 2, with keys that are compared beforehand or without.
BoundOperator bound_pairs(const JoinTypes& types, bool has_predicate, std::optional<JoinKeys> keys,
                          const std::vector<bool>& read) {
  PairsTuples role{types.left.attributes().size(), has_predicate, keys};
  if (keys)
    role.of_attributes = [=](const std::vector<bool>& wanted) {
      return bound_pairs(types, has_predicate, keys, wanted);
    };
  else
    role.with_equal = [=](JoinKeys equal) { return bound_pairs(types, has_predicate, equal, {}); };
  return {TypeExpr::stream(types.joined),
          [=](const std::vector<Datum>& given, Context& context) -> Result<Datum> {
            const auto predicate = has_predicate ? given[2].function_ptr() : nullptr;
            if (keys) {
              A3D_ASSIGN(TupleStreamPtr pairs,
                         equal_pairs(given[0].tuples(), *given[1].tuples(), {*keys, read, predicate}, context));
              return Datum{std::move(pairs)};
            }
            A3D_ASSIGN(TupleBuffer right, buffered(*given[1].tuples(), context));
            return Datum{joined_pairs(given[0].tuples(), std::move(right), predicate, context)};
          },
          std::move(role), text_of(keys, types)};
}

Result<BoundOperator> map_product(std::span<const ArgumentType> arguments) {
  A3D_ASSIGN(const JoinTypes types, join_types(MappingCheck("product", arguments)));
  return bound_pairs(types, false, std::nullopt, {});
}

Result<BoundOperator> map_symmjoin(std::span<const ArgumentType> arguments) {
  const MappingCheck check("symmjoin", arguments);
  A3D_ASSIGN(const JoinTypes types, join_types(check));
  A3D_TRY(check.function(2, {types.left, types.right}, "bool"));
  return bound_pairs(types, true, std::nullopt, {});
}

/// Each tuple joined with each tuple of the stream that the function gives for it.
Datum looped(std::vector<Datum> given, const Context& context) {
  return Datum{
      make_stream([outer_tuples = given[0].tuples(), function = given[1].function_ptr(), &context, outer = TuplePtr(),
                   inner_tuples = TupleStreamPtr(), step = 0U]() mutable -> Result<TuplePtr> {
        while (true) {
          if (++step % 1024 == 0) A3D_TRY(context.check_cancelled());
          if (inner_tuples != nullptr) {
            A3D_ASSIGN(const TuplePtr inner, inner_tuples->next());
            if (inner != nullptr) return concatenated(*outer, *inner);
          }
          A3D_ASSIGN(outer, outer_tuples->next());
          if (outer == nullptr) return TuplePtr();
          const Datum argument{outer};
          A3D_ASSIGN(const Datum stream, function->call({&argument, 1}));
          inner_tuples = stream.tuples();
        }
      })};
}

/// The tuples of the streams that a function gives, one after the other.
class ChainedStreams final : public TupleStream {
 public:
  ChainedStreams(TupleStreamPtr outer, std::shared_ptr<const Function> function, const Context& context)
      : outer_(std::move(outer)), function_(std::move(function)), context_(context) {}

  Result<TuplePtr> next() override {
    while (true) {
      if (inner_ != nullptr) {
        A3D_ASSIGN(TuplePtr tuple, inner_->next());
        if (tuple != nullptr) return tuple;
      }
      A3D_ASSIGN(const bool has_stream, next_stream());
      if (!has_stream) return TuplePtr();
    }
  }
  bool has_batches() const override { return true; }
  Result<const Batch*> next_batch(std::size_t most) override {
    while (true) {
      if (inner_ != nullptr) {
        A3D_ASSIGN(const Batch* const batch, batches_->next(most));
        if (batch != nullptr) return batch;
      }
      A3D_ASSIGN(const bool has_stream, next_stream());
      if (!has_stream) return nullptr;
    }
  }

 private:
  Result<bool> next_stream() {
    A3D_TRY(context_.check_cancelled());
    A3D_ASSIGN(outer_tuple_, outer_->next());
    if (outer_tuple_ == nullptr) return false;
    const Datum argument{outer_tuple_};
    A3D_ASSIGN(const Datum stream, function_->call({&argument, 1}));
    inner_ = stream.tuples();
    batches_.emplace(*inner_);
    return true;
  }

  TupleStreamPtr outer_;
  std::shared_ptr<const Function> function_;
  const Context& context_;
  TuplePtr outer_tuple_;
  TupleStreamPtr inner_;
  std::optional<BatchReader> batches_;  // of it
};

/// The tuple type of the stream that the function at place 1 gives.
Result<TypeExpr> inner_type(const MappingCheck& check, const TypeExpr& outer) {
  A3D_TRY(check.takes(check[1].type, {outer}));
  const TypeExpr inner = check[1].type.function_result();
  if (inner.is_tuple_stream()) return inner.element();
  return check.expected("a function that gives a stream of tuples", inner);
}

Result<BoundOperator> map_loopjoin(std::span<const ArgumentType> arguments) {
  const MappingCheck check("loopjoin", arguments);
  A3D_ASSIGN(const TypeExpr left, check.stream(0));
  A3D_ASSIGN(const TypeExpr inner, inner_type(check, left));
  A3D_ASSIGN(const TypeExpr joined, check.concatenated(left, inner));
  return BoundOperator{TypeExpr::stream(joined), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         return looped(std::move(given), context);
                       }};
}

Result<BoundOperator> map_loopsel(std::span<const ArgumentType> arguments) {
  const MappingCheck check("loopsel", arguments);
  A3D_ASSIGN(const TypeExpr left, check.stream(0));
  A3D_ASSIGN(const TypeExpr inner, inner_type(check, left));
  return BoundOperator{TypeExpr::stream(inner),
                       [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         return Datum{TupleStreamPtr(
                             std::make_shared<ChainedStreams>(given[0].tuples(), given[1].function_ptr(), context))};
                       },
                       ChainsStreams{}};
}

}  // namespace

void register_joins(algebra3d::OperatorGroup& group) {
  const std::string left = "[const rel(tuple([A: int])) value ((1) (2) (undefined))] feed ";
  const std::string right = "[const rel(tuple([B: int])) value ((2) (3) (undefined))] feed ";
  group.add({
      .name = "product",
      .syntax = "_ _ product",
      .doc = "Every tuple of the first stream joined with every tuple of the second.",
      .detail = "The second stream is materialised, beyond the memory of `set \"memory\"` in a temporary file. "
                "Attribute names must be disjoint.",
      .stream = stream_operator(map_product),
      .signatures = {"(stream(tuple) stream(tuple)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{left + right + "product count", "9"},
                         {left + "head[1] " + right + "product consume", "((1 2) (1 3) (1 undefined))"}},
      .query_errors = {{"query " + left + left + "product count",
                        "product: duplicate attribute name 'A'; rename one side"}},
  });
  group.add({
      .name = "symmjoin",
      .syntax = "_ _ symmjoin[fun(TUPLE, TUPLE2)]",
      .doc = "The pairs of tuples of both streams for which the predicate is a defined TRUE.",
      .detail = "`.A` is an attribute of the first, `..B` of the second tuple. The second stream is materialised, "
                "beyond the memory of `set \"memory\"` in a temporary file.",
      .stream = stream_operator(map_symmjoin),
      .signatures = {"(stream(tuple) stream(tuple) (map tuple tuple bool)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{left + right + "symmjoin[.A < ..B] consume", "((1 2) (1 3) (2 3))"}},
      .query_errors = {{"query " + left + right + "symmjoin[.A] count",
                        "symmjoin: expected a function that gives bool, got int"}},
  });
  group.add({
      .name = "loopjoin",
      .syntax = "_ loopjoin[fun(TUPLE)]",
      .doc = "Each tuple joined with each tuple of the stream that the function returns for it.",
      .stream = stream_operator(map_loopjoin),
      .signatures = {"(stream(tuple) (map tuple stream(tuple))) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{left + "loopjoin[fun(t: TUPLE) intstream(1, attr(t, A)) transformstream] consume",
                          "((1 1) (2 1) (2 2))"}},
      .query_errors = {{"query " + left + "loopjoin[.A] count",
                        "loopjoin: expected a function that gives a stream of tuples, got int"}},
  });
  group.add({
      .name = "loopsel",
      .syntax = "_ loopsel[fun(TUPLE)]",
      .doc = "The concatenation of the streams that the function returns for the tuples.",
      .stream = stream_operator(map_loopsel),
      .signatures = {"(stream(tuple) (map tuple stream(tuple))) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{left + "loopsel[intstream(1, .A) transformstream] consume", "((1) (1) (2))"}},
      .query_errors = {{"query " + left + "loopsel[.A] count",
                        "loopsel: expected a function that gives a stream of tuples, got int"},
                       {"query " + left + "loopsel[intstream(1, .A)] count",
                        "loopsel: expected a function that gives a stream of tuples, got (stream int)"}},
  });
}

}  // namespace queries
