// nest, unnest, afeed, aconsume: between tuples and relations that are values of attributes.
#include <algorithm>

#include "algebra3d/values/types/nested_relation.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/adjacent_groups.h"
#include "queries/streams/detail/nested_tuples.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

using algebra3d::NestedRelationType;

Result<BoundOperator> map_aconsume(std::span<const ArgumentType> arguments) {
  const MappingCheck check("aconsume", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const NestedRelationType* type, NestedRelationType::of(tuple));
  return BoundOperator{
      type->term(), [type](std::vector<Datum> given, Context& context) -> Result<Datum> {
        A3D_ASSIGN(Value relation,
                   collected_relation(*given[0].tuples(), all_attributes(type->tuple()), *type, "aconsume", context));
        return Datum{std::move(relation)};
      }};
}

Result<BoundOperator> map_afeed(std::span<const ArgumentType> arguments) {
  const MappingCheck check("afeed", arguments);
  const TypeExpr& type = check[0].type;
  if (!type.is_nested_relation()) return check.expected("a nested relation", type);
  return BoundOperator{TypeExpr::stream(type.element()),
                       [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         A3D_ASSIGN(TupleStreamPtr tuples, tuples_of_nested(given[0].value(), context));
                         return Datum{std::move(tuples)};
                       }};
}

/// The indices of all attributes but those.
std::vector<std::size_t> others(const TypeExpr& tuple, const std::vector<std::size_t>& indices) {
  std::vector<std::size_t> rest;
  for (std::size_t i = 0; i < tuple.attributes().size(); ++i)
    if (std::ranges::find(indices, i) == indices.end()) rest.push_back(i);
  return rest;
}

Result<BoundOperator> map_nest(std::span<const ArgumentType> arguments) {
  const MappingCheck check("nest", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const auto keys, check.distinct_or_no_attributes(1, tuple));
  const std::vector<std::size_t> nested = others(tuple, keys);
  if (nested.empty()) return check.error("no attribute would be left for the nested relation");
  A3D_ASSIGN(const NestedRelationType* type, NestedRelationType::of(projected(tuple, nested)));
  A3D_ASSIGN(const TypeExpr result,
             check.concatenated(projected(tuple, keys), TypeExpr::tuple({{arguments[2].names[0], type->term()}})));
  return BoundOperator{
      TypeExpr::stream(result), [keys, nested, type](std::vector<Datum> given, Context& context) -> Result<Datum> {
        return Datum{make_stream(
            [groups = AdjacentGroups(given[0].tuples(), keys), nested, type, &context]() mutable -> Result<TuplePtr> {
              A3D_ASSIGN(auto group, groups.next(context));
              if (!group) return TuplePtr();
              Tuple row{std::move(group->keys)};
              A3D_ASSIGN(Value relation, collected_relation(*group->tuples.scan(), nested, *type, "nest", context));
              row.attributes.push_back(std::move(relation));
              return TuplePtr(std::make_shared<const Tuple>(std::move(row)));
            })};
      }};
}

/// The tuples of the nested relation `relation` of each tuple, behind its attributes `kept`.
class UnnestStream final : public TupleStream {
 public:
  UnnestStream(TupleStreamPtr tuples, std::vector<std::size_t> kept, std::size_t relation, const Context& context)
      : tuples_(std::move(tuples)), kept_(std::move(kept)), relation_(relation), context_(context) {}

  Result<TuplePtr> next() override {
    while (true) {
      if (++step_ % 1024 == 0) A3D_TRY(context_.check_cancelled());
      if (inner_ != nullptr) {
        A3D_ASSIGN(const TuplePtr inner, inner_->next());
        if (inner != nullptr) return joined(*inner);
      }
      A3D_ASSIGN(current_, tuples_->next());
      if (current_ == nullptr) return TuplePtr();
      A3D_ASSIGN(inner_, tuples_of_nested(current_->attributes[relation_], context_));
    }
  }

 private:
  TuplePtr joined(const Tuple& inner) const {
    Tuple result;
    result.attributes.reserve(kept_.size() + inner.attributes.size());
    for (const std::size_t index : kept_) result.attributes.push_back(current_->attributes[index]);
    result.attributes.insert(result.attributes.end(), inner.attributes.begin(), inner.attributes.end());
    return std::make_shared<const Tuple>(std::move(result));
  }

  TupleStreamPtr tuples_;
  std::vector<std::size_t> kept_;
  std::size_t relation_;
  const Context& context_;
  TuplePtr current_;
  TupleStreamPtr inner_;  // of the current tuple
  std::uint32_t step_ = 0;
};

Result<BoundOperator> map_unnest(std::span<const ArgumentType> arguments) {
  const MappingCheck check("unnest", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const std::size_t relation, check.attribute(1, tuple));
  const TypeExpr& type = tuple.attributes()[relation].type;
  if (!type.is_nested_relation()) return check.expected("an attribute that is a nested relation", type);
  const std::vector<std::size_t> kept = others(tuple, {relation});
  A3D_ASSIGN(const TypeExpr result, check.concatenated(projected(tuple, kept), type.element()));
  return BoundOperator{
      TypeExpr::stream(result), [kept, relation](std::vector<Datum> given, Context& context) -> Result<Datum> {
        return Datum{TupleStreamPtr(std::make_shared<UnnestStream>(given[0].tuples(), kept, relation, context))};
      }};
}

// Two groups by K, as a relation that the examples share.
constexpr const char* kFlat = R"([const rel(tuple([K: int, A: string])) value ((1 "a") (1 "b") (2 "c"))] feed )";
constexpr const char* kNested =
    R"([const rel(tuple([K: int, R: arel(tuple([A: string]))])) value ((1 (("a") ("b"))) (2 ()) (3 undefined))] )"
    "feed ";

}  // namespace

void register_nesting(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "nest",
      .syntax = "_ nest[attributes; name]",
      .doc = "One tuple per run of adjacent tuples with equal values of the named attributes: these attributes, then "
             "the tuples of the others as a nested relation.",
      .detail = "Sort by the named attributes first (`sortby`), as for `groupby`; otherwise equal values that are "
                "apart give several tuples. Undefined equals undefined. Without attributes all tuples are one "
                "relation. The nested relation must fit into the work memory.",
      .stream = stream_operator(map_nest),
      .signatures = {"(stream(tuple) NAMES NAME) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{std::string(kFlat) + "nest[K; R] consume", R"(((1 (("a") ("b"))) (2 (("c")))))"},
                         {std::string(kFlat) + "nest[; R] extend[N: .R count] project[N] consume", "((3))"},
                         {"[const rel(tuple([K: int, A: int])) value ((undefined 1) (undefined 2))] feed nest[K; R] "
                          "consume",
                          "((undefined ((1) (2))))"}},
      .query_errors = {{"query intstream(1, 3) transformstream nest[Elem; R] count",
                        "nest: no attribute would be left for the nested relation"},
                       {"query " + std::string(kFlat) + "nest[K; K] count", "nest: duplicate attribute name 'K'"}},
  });
  group.add({
      .name = "unnest",
      .syntax = "_ unnest[attribute]",
      .doc = "For each tuple one tuple per tuple of the named nested relation: the other attributes, then those of the "
             "nested relation.",
      .detail = "Tuples whose nested relation is empty or undefined are dropped.",
      .stream = stream_operator(map_unnest),
      .signatures = {"(stream(tuple) NAME) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{std::string(kNested) + "unnest[R] consume", R"(((1 "a") (1 "b")))"},
                         {std::string(kFlat) + "nest[K; R] unnest[R] consume", R"(((1 "a") (1 "b") (2 "c")))"}},
      .query_errors = {{"query " + std::string(kFlat) + "unnest[K] count",
                        "unnest: expected an attribute that is a nested relation, got int"},
                       {"query " + std::string(kFlat) +
                            "extend[R: intstream(1, 2) transformstream extend[K: 1] "
                            "aconsume] unnest[R] count",
                        "unnest: duplicate attribute name 'K'"}},
  });
  group.add({
      .name = "afeed",
      .syntax = "_ afeed",
      .doc = "A stream of the tuples of a nested relation, in their order; `feed` does the same.",
      .detail = "No tuples if the nested relation is undefined.",
      .stream = stream_operator(map_afeed),
      .signatures = {"(arel(tuple)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{std::string(kNested) + R"(extend[N: .R afeed filter[.A = "b"] count] project[K, N] consume)",
                          "((1 1) (2 0) (3 0))"}},
      .query_errors = {{"query 5 afeed count", "afeed: expected a nested relation, got int"}},
  });
  group.add({
      .name = "aconsume",
      .syntax = "_ aconsume",
      .doc = "The nested relation of all tuples of a stream: a relation as the value of an attribute.",
      .detail = "All values are loaded, and must fit into the work memory.",
      .stream = stream_operator(map_aconsume),
      .signatures = {"(stream(tuple)) -> arel(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 2) transformstream extend[R: intstream(1, .Elem) transformstream aconsume] "
                          "consume",
                          "((1 ((1))) (2 ((1) (2))))"},
                         {std::string(kFlat) + "groupby[K; R: group feed project[A] aconsume] consume",
                          R"(((1 (("a") ("b"))) (2 (("c")))))"},
                         {"[const int value undefined] feed transformstream aconsume", "((undefined))"}},
      .query_errors = {{"query 5 aconsume", "aconsume: expected a stream of tuples, got int"}},
  });
}

}  // namespace queries
