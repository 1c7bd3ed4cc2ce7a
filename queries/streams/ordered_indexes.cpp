// createbtree, exactmatch, range, leftrange, rightrange: ordered indexes on relations.
#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/index_operands.h"
#include "queries/streams/ordered_index.h"

namespace queries {
namespace {

Result<std::shared_ptr<const OrderedTree>> tree_of(const Datum& source, const IndexSource& from, std::size_t attribute,
                                                   const Context& context) {
  std::vector<OrderedTree::Entry> entries;
  A3D_TRY(for_each_indexed(source, from.id_attribute, "createbtree", context,
                           [&](const Tuple& tuple, TupleId id) -> Status {
                             A3D_ASSIGN(Value key, tuple.attributes[attribute].loaded());
                             if (key.is_defined()) entries.push_back({std::move(key), id});
                             return {};
                           }));
  return std::make_shared<const OrderedTree>(OrderedTree::bulk_load(std::move(entries)));
}

// An index on a stored relation that is to be stored is made by the store, and not here.
Result<Datum> create_index(const Datum& source, const IndexSource& from, std::size_t attribute,
                           const Context& context) {
  const std::string& name = from.given.attributes()[attribute].name;
  if (std::string relation = stored_name(source); !relation.empty()) {
    const auto make = [=, &context]() -> Result<std::shared_ptr<const OrderedEntries>> {
      A3D_ASSIGN(std::shared_ptr<const OrderedEntries> tree, tree_of(source, from, attribute, context));
      return tree;
    };
    return Datum{std::make_shared<OrderedIndex>(std::move(relation), name, std::make_shared<DeferredOrder>(make))};
  }
  A3D_ASSIGN(auto tree, tree_of(source, from, attribute, context));
  return Datum{std::make_shared<OrderedIndex>(name, std::move(tree))};
}

Result<BoundOperator> map_createbtree(std::span<const ArgumentType> arguments) {
  const MappingCheck check("createbtree", arguments);
  A3D_ASSIGN(const IndexSource from, index_source(check));
  A3D_ASSIGN(const std::size_t attribute, check.attribute(1, from.given));
  return BoundOperator{
      TypeExpr("btree", {from.indexed, from.given.attributes()[attribute].type}),
      [=](std::vector<Datum> given, Context& context) { return create_index(given[0], from, attribute, context); }};
}

/// Which of the arguments are the bounds of a search; the position of none is 0.
struct Bounds {
  const char* op;
  std::size_t low;
  std::size_t high;
};

/// The key that an argument stands for; nothing if there is no such bound.
std::optional<Value> bound(const std::vector<Datum>& given, std::size_t position, Conversion conversion) {
  return position == 0 ? std::optional<Value>() : converted(given[position].value(), conversion);
}

/// The tuples that a search finds; of each the attributes in `read`.
Result<Datum> found(const std::vector<Datum>& given, const Bounds& bounds, const std::vector<Conversion>& conversions,
                    const std::vector<bool>& read, const Context& context) {
  const auto& index = given[0].ordered_index();
  A3D_TRY(check_fits(*index, *given[1].relation(), bounds.op));
  std::optional<Value> low = bound(given, bounds.low, conversions[bounds.low]);
  std::optional<Value> high = bound(given, bounds.high, conversions[bounds.high]);
  // Nothing lies beside an undefined bound.
  for (std::optional<Value>* each : {&low, &high}) {
    if (!*each) continue;
    if (!(*each)->is_defined()) return Datum{make_stream([]() -> Result<TuplePtr> { return TuplePtr(); })};
    A3D_ASSIGN(*each, (*each)->loaded());
  }
  A3D_ASSIGN(std::vector<TupleId> ids, index->entries().range(low, high));
  // The keys in the index are proved when they are found: StoredOrder.
  return Datum{found_tuples(given[1].relation(), index, {std::move(ids), read, {}, {}}, context)};
}

/// How a search by an index is done.
struct SearchPlan {
  TypeExpr tuple;
  Bounds bounds;
  std::vector<Conversion> conversions;
  std::vector<bool> read;
};

BoundOperator search_operator(const SearchPlan& plan) {
  return {TypeExpr::stream(plan.tuple),
          [plan](const std::vector<Datum>& given, Context& context) {
            return found(given, plan.bounds, plan.conversions, plan.read, context);
          },
          FindsTuples{[plan](std::vector<bool> read) {
            return search_operator({plan.tuple, plan.bounds, plan.conversions, std::move(read)});
          }},
          text_of_read(plan.tuple, plan.read)};
}

TypeMapping map_search(Bounds bounds) {
  return [bounds](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check(bounds.op, arguments);
    const TypeExpr& index = check[0].type;
    if (!index.is("btree") || index.arguments().size() != 2) return check.expected("a B-tree", index);
    A3D_ASSIGN(const TypeExpr tuple, check.relation(1));
    if (!(index.arguments()[0] == tuple))
      return check.error("expected an index on the relation's tuples, got " + index.text());
    std::vector<Conversion> conversions(check.count());
    for (std::size_t position = 2; position < check.count(); ++position) {
      A3D_ASSIGN(conversions[position], check.conversion(position, index.arguments()[1]));
    }
    return search_operator({tuple, bounds, conversions, std::vector<bool>(tuple.attributes().size(), true)});
  };
}

struct SearchTexts {
  Bounds bounds;
  const char* places;
  const char* signature;
  const char* doc;
  const char* arguments;  ///< of the example on the numbers 1, 2 and 3
  const char* example;
  const char* undefined;
};

constexpr SearchTexts kSearches[] = {
    {{"exactmatch", 2, 2},
     "_",
     "DATA",
     "The tuples of a relation whose indexed value equals the given one.",
     "2",
     "((2))",
     "[const int value undefined]"},
    {{"range", 2, 3},
     "_, _",
     "DATA DATA",
     "The tuples of a relation whose indexed value lies between the bounds, both included.",
     "2, 9",
     "((2) (3))",
     "1, [const int value undefined]"},
    {{"leftrange", 0, 2},
     "_",
     "DATA",
     "The tuples of a relation whose indexed value is not greater than the given one.",
     "2",
     "((1) (2))",
     "[const int value undefined]"},
    {{"rightrange", 2, 0},
     "_",
     "DATA",
     "The tuples of a relation whose indexed value is not less than the given one.",
     "2",
     "((2) (3))",
     "[const int value undefined]"}};

}  // namespace

void register_ordered_indexes(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "createbtree",
      .syntax = "_ createbtree[attribute]",
      .doc = "An ordered index over the values of an attribute.",
      .detail =
          "An index on a stream is a frozen copy. The stream has the ids in an attribute of type tid, or its tuples "
          "come straight from a stored relation. Undefined values are left out.",
      .cost = algebra3d::Cost::sorting,
      .stream = stream_operator(map_createbtree),
      .signatures = {"(rel(tuple) NAME) -> btree(tuple DATA)", "(stream(tuple) NAME) -> btree(tuple DATA)"},
      .handles_undefined = true,
      .query_examples = {{"Boxes createbtree[No] Boxes exactmatch[2] project[No] consume", "((2))"},
                         {"Boxes feed addid createbtree[No] Boxes rightrange[2] count", "2"}},
      .query_errors =
          {{"query Boxes createbtree[Nr] Boxes exactmatch[2] count",
            "createbtree: unknown attribute 'Nr', did you mean 'No'?"},
           {"query Boxes feed extend[X: 1] createbtree[No] Boxes feed extend[X: 1] consume exactmatch[2] count",
            "createbtree: the tuples have no ids"}},
  });
  for (const SearchTexts& texts : kSearches) {
    const std::string name = texts.bounds.op;
    const std::string start = "Boxes createbtree[No] Boxes " + name + "[";
    group.add({
        .name = name,
        .syntax = "_ _ " + name + "[" + texts.places + "]",
        .doc = texts.doc,
        .detail =
            "In the order of the indexed values, then of the tuples. An int is accepted where the values are real, "
            "and strings and texts for each other. No tuples for an undefined argument.",
        .stream = stream_operator(map_search(texts.bounds)),
        .signatures = {std::string("(btree(tuple DATA) rel(tuple) ") + texts.signature + ") -> stream(tuple)"},
        .handles_undefined = true,
        .query_examples = {{start + texts.arguments + "] project[No] consume", texts.example},
                           {start + texts.undefined + "] count", "0"}},
        .query_errors = {{"query 5 Boxes " + name + "[" + texts.arguments + "]", name + ": expected a B-tree, got int"},
                         {fmt::format("query Boxes createbtree[B] Boxes {}[{}] count", name, texts.arguments),
                          name + ": expected rect3, got int"}},
    });
  }
}

}  // namespace queries
