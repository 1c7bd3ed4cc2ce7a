// product, symmjoin, hashjoin, loopjoin: pairs of tuples.
#include <array>
#include <unordered_map>

#include "queries/streams/all.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"

namespace queries {
namespace {

using Tuples = std::shared_ptr<const std::vector<TuplePtr>>;

Result<Tuples> buffered(const Datum& stream, Context& context) {
  ASSIGN_OR_RETURN(auto tuples, materialise(*stream.tuples(), context));
  return std::make_shared<const std::vector<TuplePtr>>(std::move(tuples));
}

/// Every tuple of the left stream with every tuple on the right, the left one varying slowest.
class NestedLoop {
 public:
  NestedLoop(TupleStreamPtr left, Tuples right, const Context& context)
      : left_(std::move(left)), right_(std::move(right)), position_(right_->size()), context_(context) {}

  /// The next pair; null on both sides at the end.
  Result<std::pair<TuplePtr, TuplePtr>> next() {
    if (++steps_ % 4096 == 0) RETURN_IF_ERROR(context_.check_cancelled());
    while (position_ == right_->size()) {
      ASSIGN_OR_RETURN(current_, left_->next());
      if (current_ == nullptr || right_->empty()) return std::pair<TuplePtr, TuplePtr>();
      position_ = 0;
    }
    return std::pair(current_, (*right_)[position_++]);
  }

 private:
  TupleStreamPtr left_;
  Tuples right_;
  std::size_t position_;
  TuplePtr current_;
  const Context& context_;
  std::uint32_t steps_ = 0;
};

struct JoinTypes {
  TypeExpr left, right, joined;
};

Result<JoinTypes> join_types(const MappingCheck& check) {
  JoinTypes types;
  ASSIGN_OR_RETURN(types.left, check.stream(0));
  ASSIGN_OR_RETURN(types.right, check.stream(1));
  ASSIGN_OR_RETURN(types.joined, check.concatenated(types.left, types.right));
  return types;
}

Result<Plan> map_product(std::span<const ArgumentType> arguments) {
  ASSIGN_OR_RETURN(const JoinTypes types, join_types(MappingCheck("product", arguments)));
  return Plan{TypeExpr::stream(types.joined), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                ASSIGN_OR_RETURN(Tuples right, buffered(given[1], context));
                return Datum{make_stream(
                    [loop = NestedLoop(given[0].tuples(), std::move(right), context)]() mutable -> Result<TuplePtr> {
                      ASSIGN_OR_RETURN(const auto pair, loop.next());
                      return pair.first == nullptr ? TuplePtr() : concatenated(*pair.first, *pair.second);
                    })};
              }};
}

Result<Plan> map_symmjoin(std::span<const ArgumentType> arguments) {
  const MappingCheck check("symmjoin", arguments);
  ASSIGN_OR_RETURN(const JoinTypes types, join_types(check));
  RETURN_IF_ERROR(check.function(2, "bool"));
  return Plan{TypeExpr::stream(types.joined), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                ASSIGN_OR_RETURN(Tuples right, buffered(given[1], context));
                return Datum{make_stream([loop = NestedLoop(given[0].tuples(), std::move(right), context),
                                          predicate = given[2].function_ptr()]() mutable -> Result<TuplePtr> {
                  while (true) {
                    ASSIGN_OR_RETURN(auto pair, loop.next());
                    if (pair.first == nullptr) return TuplePtr();
                    const std::array<Datum, 2> both = {Datum{pair.first}, Datum{pair.second}};
                    ASSIGN_OR_RETURN(const Datum holds, predicate->call(both));
                    if (is_true(holds.value())) return concatenated(*pair.first, *pair.second);
                  }
                })};
              }};
}

/// Tuples by the hash of a key; undefined keys are left out. Entries of one hash keep the order of the stream.
class HashTable {
 public:
  Status fill(TupleStream& tuples, std::size_t key, Context& context) {
    return for_each_tuple(tuples, context, [&](const TuplePtr& tuple) -> Status {
      ASSIGN_OR_RETURN(Value value, tuple->attributes[key].loaded());
      if (!value.is_defined()) return {};
      auto& bucket = buckets_[hash(value)];
      bucket.push_back({std::move(value), tuple});
      return {};
    });
  }
  std::vector<TuplePtr> matches(const Value& key) const {
    std::vector<TuplePtr> found;
    const auto bucket = buckets_.find(hash(key));
    if (bucket == buckets_.end()) return found;
    for (const auto& [value, tuple] : bucket->second)
      if (compare(value, key) == 0) found.push_back(tuple);
    return found;
  }

 private:
  std::unordered_map<std::size_t, std::vector<std::pair<Value, TuplePtr>>> buckets_;
};

/// For each tuple of a stream its partners, as `find` gives them: (left, right) in the order of the left stream.
template <typename Find>
TupleStreamPtr partners(TupleStreamPtr left, Find find) {
  return make_stream([left = std::move(left), find = std::move(find), current = TuplePtr(),
                      found = std::vector<TuplePtr>(), position = std::size_t{0}]() mutable -> Result<TuplePtr> {
    while (position == found.size()) {
      ASSIGN_OR_RETURN(current, left->next());
      if (current == nullptr) return TuplePtr();
      ASSIGN_OR_RETURN(found, find(*current));
      position = 0;
    }
    return concatenated(*current, *found[position++]);
  });
}

Result<Plan> map_hashjoin(std::span<const ArgumentType> arguments) {
  const MappingCheck check("hashjoin", arguments);
  ASSIGN_OR_RETURN(const JoinTypes types, join_types(check));
  RETURN_IF_ERROR(check.argument_count(4, 5));
  ASSIGN_OR_RETURN(const std::size_t left_key, check.attribute(2, types.left));
  ASSIGN_OR_RETURN(const std::size_t right_key, check.attribute(3, types.right));
  const TypeExpr& left_type = types.left.attributes()[left_key].type;
  const TypeExpr& right_type = types.right.attributes()[right_key].type;
  if (!(left_type == right_type))
    return check.error("expected attributes of one type, got " + left_type.text() + " and " + right_type.text());
  if (check.count() == 5) RETURN_IF_ERROR(check.type(4, "int"));
  return Plan{TypeExpr::stream(types.joined), [=](std::vector<Datum> given, Context& context) -> Result<Datum> {
                auto table = std::make_shared<HashTable>();
                RETURN_IF_ERROR(table->fill(*given[1].tuples(), right_key, context));
                return Datum{partners(given[0].tuples(), [=](const Tuple& tuple) -> Result<std::vector<TuplePtr>> {
                  ASSIGN_OR_RETURN(const Value key, tuple.attributes[left_key].loaded());
                  if (!key.is_defined()) return std::vector<TuplePtr>();
                  return table->matches(key);
                })};
              }};
}

Result<Plan> map_loopjoin(std::span<const ArgumentType> arguments) {
  const MappingCheck check("loopjoin", arguments);
  ASSIGN_OR_RETURN(const TypeExpr left, check.stream(0));
  const TypeExpr inner = check[1].type.function_result();
  if (!inner.is_tuple_stream()) return check.expected("a function that gives a stream of tuples", inner);
  ASSIGN_OR_RETURN(const TypeExpr joined, check.concatenated(left, inner.element()));
  return Plan{
      TypeExpr::stream(joined), [](std::vector<Datum> given, Context&) -> Result<Datum> {
        return Datum{make_stream([left_tuples = given[0].tuples(), function = given[1].function_ptr(),
                                  current = TuplePtr(), right = TupleStreamPtr()]() mutable -> Result<TuplePtr> {
          while (true) {
            if (right != nullptr) {
              ASSIGN_OR_RETURN(const TuplePtr partner, right->next());
              if (partner != nullptr) return concatenated(*current, *partner);
            }
            ASSIGN_OR_RETURN(current, left_tuples->next());
            if (current == nullptr) return TuplePtr();
            const Datum argument{current};
            ASSIGN_OR_RETURN(const Datum stream, function->call({&argument, 1}));
            right = stream.tuples();
          }
        })};
      }};
}

}  // namespace

void register_joins(algebra3d::Registry& registry) {
  const std::string left = "[const rel(tuple([A: int])) value ((1) (2) (undefined))] feed ";
  const std::string right = "[const rel(tuple([B: int])) value ((2) (3) (undefined))] feed ";
  registry.add({
      .name = "product",
      .syntax = "_ _ product",
      .doc = "Every tuple of the first stream joined with every tuple of the second.",
      .detail = "The second stream is held in memory. Attribute names must be disjoint.",
      .stream = stream_operator(map_product),
      .signatures = {"(stream(tuple) stream(tuple)) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{left + right + "product count", "9"},
                   {left + "head[1] " + right + "product consume", "((1 2) (1 3) (1 undefined))"}},
      .errors = {{"query " + left + left + "product count",
                  "product: the attribute 'A' would stand twice; rename one side"}},
  });
  registry.add({
      .name = "symmjoin",
      .syntax = "_ _ symmjoin[fun(TUPLE, TUPLE2)]",
      .doc = "The pairs of tuples of both streams for which the predicate is a defined TRUE.",
      .detail = "`.A` is an attribute of the first, `..B` of the second tuple. The second stream is held in memory.",
      .stream = stream_operator(map_symmjoin),
      .signatures = {"(stream(tuple) stream(tuple) (map tuple tuple bool)) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{left + right + "symmjoin[.A < ..B] consume", "((1 2) (1 3) (2 3))"}},
      .errors = {{"query " + left + right + "symmjoin[.A] count",
                  "symmjoin: expected a function that gives bool, got int"}},
  });
  registry.add({
      .name = "hashjoin",
      .syntax = "_ _ hashjoin[attribute, attribute ...]",
      .doc = "The pairs of tuples of both streams with equal, defined values of the two attributes.",
      .detail = "The second stream is held in memory. A bucket count as a third argument is accepted and not needed.",
      .stream = stream_operator(map_hashjoin),
      .signatures = {"(stream(tuple) stream(tuple) NAME NAME) -> stream(tuple)",
                     "(stream(tuple) stream(tuple) NAME NAME int) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{left + right + "hashjoin[A, B] consume", "((2 2))"},
                   {left + right + "hashjoin[A, B, 97] count", "1"}},
      .errors = {{"query " + left + right + "extend[C: TRUE] hashjoin[A, C] count",
                  "hashjoin: expected attributes of one type, got int and bool"}},
  });
  registry.add({
      .name = "loopjoin",
      .syntax = "_ loopjoin[fun(TUPLE)]",
      .doc = "Each tuple joined with each tuple of the stream that the function gives for it.",
      .stream = stream_operator(map_loopjoin),
      .signatures = {"(stream(tuple) (map tuple stream(tuple))) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{left + "loopjoin[fun(t: TUPLE) intstream(1, attr(t, A)) transformstream] consume",
                    "((1 1) (2 1) (2 2))"}},
      .errors = {{"query " + left + "loopjoin[.A] count",
                  "loopjoin: expected a function that gives a stream of tuples, got int"}},
  });
}

}  // namespace queries
