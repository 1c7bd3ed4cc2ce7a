// sortby, groupby: order, and what is equal within it.
#include <algorithm>

#include "queries/streams/all.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"

namespace queries {
namespace {

struct SortKey {
  std::size_t attribute;
  bool is_descending;
};

/// A tuple with its key values at hand, loaded.
struct KeyedTuple {
  std::vector<Value> keys;
  TuplePtr tuple;
};

Result<std::vector<Value>> loaded_keys(const Tuple& tuple, const std::vector<std::size_t>& attributes) {
  std::vector<Value> keys;
  for (const std::size_t attribute : attributes) {
    ASSIGN_OR_RETURN(Value key, tuple.attributes[attribute].loaded());
    keys.push_back(std::move(key));
  }
  return keys;
}

std::strong_ordering compare_keys(const std::vector<Value>& a, const std::vector<Value>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (const auto order = compare(a[i], b[i]); order != 0) return order;
  return std::strong_ordering::equal;
}

bool is_before(const std::vector<SortKey>& order, const KeyedTuple& a, const KeyedTuple& b) {
  for (std::size_t i = 0; i < order.size(); ++i)
    if (const auto result = compare(a.keys[i], b.keys[i]); result != 0) return (result < 0) != order[i].is_descending;
  return false;
}

// Stable, so that the same stream always comes out in the same order.
Result<std::vector<TuplePtr>> sorted(TupleStream& tuples, const std::vector<SortKey>& order, Context& context) {
  std::vector<std::size_t> attributes;
  attributes.reserve(order.size());
  for (const SortKey& key : order) attributes.push_back(key.attribute);
  std::vector<KeyedTuple> keyed;
  RETURN_IF_ERROR(for_each_tuple(tuples, context, [&](const TuplePtr& tuple) -> Status {
    ASSIGN_OR_RETURN(auto keys, loaded_keys(*tuple, attributes));
    keyed.push_back({std::move(keys), tuple});
    return {};
  }));
  std::ranges::stable_sort(keyed, [&](const auto& a, const auto& b) { return is_before(order, a, b); });
  std::vector<TuplePtr> result;
  result.reserve(keyed.size());
  for (KeyedTuple& entry : keyed) result.push_back(std::move(entry.tuple));
  return result;
}

Result<Plan> map_sortby(std::span<const ArgumentType> arguments) {
  const MappingCheck check("sortby", arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  ASSIGN_OR_RETURN(const auto attributes, check.attributes(1, tuple));
  if (attributes.empty()) return check.error("expected at least one attribute");
  std::vector<SortKey> order;
  for (std::size_t i = 0; i < attributes.size(); ++i) order.push_back({attributes[i], check[1].modifiers[i] == "desc"});
  return Plan{TypeExpr::stream(tuple), [tuple, order](std::vector<Datum> given, Context& context) -> Result<Datum> {
                ASSIGN_OR_RETURN(auto tuples, sorted(*given[0].tuples(), order, context));
                MemoryRelation relation(tuple, std::move(tuples));
                ASSIGN_OR_RETURN(TupleStreamPtr stream, relation.scan());
                return Datum{std::move(stream)};
              }};
}

/// Groups of adjacent tuples with equal keys, one after the other.
class Groups {
 public:
  Groups(TupleStreamPtr tuples, std::vector<std::size_t> keys) : tuples_(std::move(tuples)), keys_(std::move(keys)) {}

  struct Group {
    std::vector<Value> keys;
    std::vector<TuplePtr> tuples;
  };

  /// The next group; empty at the end.
  Result<Group> next(const Context& context) {
    if (!has_begun_) RETURN_IF_ERROR(advance());
    has_begun_ = true;
    Group group;
    if (pending_.tuple == nullptr) return group;
    group.keys = pending_.keys;
    while (pending_.tuple != nullptr && compare_keys(pending_.keys, group.keys) == 0) {
      group.tuples.push_back(std::move(pending_.tuple));
      if (group.tuples.size() % 1024 == 0) RETURN_IF_ERROR(context.check_cancelled());
      RETURN_IF_ERROR(advance());
    }
    return group;
  }

 private:
  Status advance() {
    ASSIGN_OR_RETURN(pending_.tuple, tuples_->next());
    if (pending_.tuple == nullptr) return {};
    ASSIGN_OR_RETURN(pending_.keys, loaded_keys(*pending_.tuple, keys_));
    return {};
  }

  TupleStreamPtr tuples_;
  std::vector<std::size_t> keys_;
  KeyedTuple pending_;
  bool has_begun_ = false;
};

Result<Plan> map_groupby(std::span<const ArgumentType> arguments) {
  const MappingCheck check("groupby", arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  ASSIGN_OR_RETURN(const auto keys, check.attributes(1, tuple));
  std::vector<TypeExpr::Attribute> key_types;
  key_types.reserve(keys.size());
  for (const std::size_t key : keys) key_types.push_back(tuple.attributes()[key]);
  ASSIGN_OR_RETURN(const TypeExpr result, check.extended(TypeExpr::tuple(std::move(key_types)), 2));
  return Plan{TypeExpr::stream(result), [tuple, keys](std::vector<Datum> given, Context& context) -> Result<Datum> {
                return Datum{make_stream([groups = Groups(given[0].tuples(), keys), functions = given[2].list(), tuple,
                                          &context]() mutable -> Result<TuplePtr> {
                  ASSIGN_OR_RETURN(auto group, groups.next(context));
                  if (group.tuples.empty()) return TuplePtr();
                  Tuple row{std::move(group.keys)};
                  const Datum relation{RelationPtr(std::make_shared<MemoryRelation>(tuple, std::move(group.tuples)))};
                  RETURN_IF_ERROR(append_results(functions, relation, row.attributes));
                  return TuplePtr(std::make_shared<const Tuple>(std::move(row)));
                })};
              }};
}

}  // namespace

void register_ordering(algebra3d::Registry& registry) {
  registry.add({
      .name = "sortby",
      .syntax = "_ sortby[keys]",
      .doc = "The tuples in the order of the named attributes, ascending unless `desc` follows; undefined comes first.",
      .detail = "Tuples with equal keys keep their order.",
      .stream = stream_operator(map_sortby),
      .signatures = {"(stream(tuple) ((NAME asc|desc) ...)) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 3) transformstream sortby[Elem desc] consume", "((3) (2) (1))"},
                   {"[const rel(tuple([A: int])) value ((2) (undefined) (1))] feed sortby[A] consume",
                    "((undefined) (1) (2))"}},
      .errors = {{"query intstream(1, 3) transformstream sortby[Name] count", "sortby: unknown attribute 'Name'"}},
  });
  registry.add({
      .name = "groupby",
      .syntax = "_ groupby[attributes; functions(GROUP)]",
      .doc =
          "One tuple per run of adjacent tuples with equal keys: the keys, then what the functions make of the group.",
      .detail = "`group` is the relation of the run. Sort first. Without keys all tuples are one group.",
      .stream = stream_operator(map_groupby),
      .signatures = {"(stream(tuple) NAMES ((NAME (map rel(tuple) DATA)) ...)) -> stream(tuple)"},
      .handles_undefined = true,
      .examples =
          {{"intstream(1, 5) transformstream extend[K: .Elem div 3] groupby[K; N: group count] consume",
            "((0 2) (1 3))"},
           {"intstream(1, 5) transformstream groupby[; S: group feed sum[Elem]] consume", "((15))"},
           {"[const rel(tuple([A: int])) value ((undefined) (undefined))] feed groupby[A; N: group count] consume",
            "((undefined 2))"}},
      .errors = {{"query intstream(1, 5) transformstream groupby[K; N: group count] count",
                  "groupby: unknown attribute 'K'"}},
  });
}

}  // namespace queries
