// creatertree, bulkloadrtree, windowintersects, windowintersectsS, distancescan, nodes: R-trees on relations.
#include <algorithm>
#include <array>
#include <functional>
#include <limits>

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/exact_scan.h"
#include "queries/streams/detail/index_operands.h"
#include "queries/streams/detail/nearest_entries.h"
#include "queries/streams/detail/parallel_filter.h"
#include "queries/streams/detail/spatial_attribute.h"
#include "queries/streams/mapping.h"
#include "queries/streams/spatial_index.h"
#include "rtree/nodes.h"

namespace queries {
namespace {

using algebra3d::Box3;
using algebra3d::Registry;
using algebra3d::ResolvedCall;
using Tree = SpatialIndex::Tree;
using Entry = rtree::Entry<std::uint64_t>;

TypeExpr index_type(const TypeExpr& tuple, const TypeExpr& key) {
  return {"rtree3", {tuple, key, "FALSE"}};
}

/// The tuple type that an index is for.
Result<TypeExpr> index_operand(const MappingCheck& check, std::size_t position) {
  const TypeExpr& type = check[position].type;
  if (type.is("rtree3") && !type.arguments().empty()) return type.arguments()[0];
  return check.expected("an R-tree", type);
}

Result<std::shared_ptr<Tree>> tree_of(const Datum& source, const IndexSource& from, std::size_t attribute,
                                      std::string_view op, const Context& context) {
  std::vector<Entry> entries;
  A3D_TRY(for_each_indexed(source, from.id_attribute, op, context, [&](const Tuple& tuple, TupleId id) -> Status {
    if (const Box3 box = window_of(tuple.attributes[attribute]); !box.is_empty())
      entries.push_back({box, static_cast<std::uint64_t>(id)});
    return {};
  }));
  return std::make_shared<Tree>(Tree::bulk_load(entries));
}

// An index on a stored relation that is to be stored is made by the store, and not here.
Result<Datum> create_index(const Datum& source, const IndexSource& from, std::size_t attribute, const char* op,
                           const Context& context) {
  const std::string& name = from.given.attributes()[attribute].name;
  if (std::string relation = stored_name(source); !relation.empty())
    return Datum{std::make_shared<SpatialIndex>(
        std::move(relation), name,
        SpatialIndex::Source{[=, &context, made = std::shared_ptr<Tree>()]() mutable -> Result<std::shared_ptr<Tree>> {
                               if (made == nullptr) {
                                 A3D_ASSIGN(made, tree_of(source, from, attribute, op, context));
                               }
                               return made;
                             },
                             {}})};
  A3D_ASSIGN(auto tree, tree_of(source, from, attribute, op, context));
  return Datum{std::make_shared<SpatialIndex>("", name, std::move(tree))};
}

TypeMapping map_creatertree(const algebra3d::Registry& registry, const char* op) {
  return [&registry, op](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check(op, arguments);
    A3D_ASSIGN(const IndexSource from, index_source(check));
    A3D_ASSIGN(const std::size_t attribute, spatial_attribute(registry, check, 1, from.given));
    return BoundOperator{index_type(from.indexed, from.given.attributes()[attribute].type),
                         [=](std::vector<Datum> given, Context& context) {
                           return create_index(given[0], from, attribute, op, context);
                         }};
  };
}

TypeMapping map_bulkloadrtree(const algebra3d::Registry& registry) {
  return [create = map_creatertree(registry, "bulkloadrtree")](
             std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    A3D_TRY(MappingCheck("bulkloadrtree", arguments).stream(0));
    return create(arguments);
  };
}

Result<TypeExpr> indexed_relation(const MappingCheck& check) {
  A3D_ASSIGN(const TypeExpr indexed, index_operand(check, 0));
  A3D_ASSIGN(TypeExpr tuple, check.relation(1));
  if (!(indexed == tuple))
    return check.error("expected an index on the relation's tuples, got " + check[0].type.text() +
                       "; to get the tuples of another relation by their ids use windowintersectsS and gettuples");
  return tuple;
}

Status check_window(const algebra3d::Registry& registry, const MappingCheck& check, std::size_t position) {
  if (is_spatial(registry, check[position].type)) return {};
  return check.expected("a rect3 or another spatial value", check[position].type);
}

/// Whether the argument at `position` is the constant "exact".
Result<bool> asks_for_exact(const MappingCheck& check, std::size_t position) {
  A3D_TRY(check.characters(position));
  if (check[position].constant) {
    A3D_ASSIGN(const Value word, check[position].constant());
    if (word.is_defined() && algebra3d::characters_of(word) == "exact") return true;
  }
  return check.error("expected the constant \"exact\"");
}

/// The search of an operator with an index and a relation as operands.
Result<IndexSearch> index_search(const std::vector<Datum>& given, std::string_view op) {
  const auto& index = given[0].index();
  const RelationPtr& relation = given[1].relation();
  A3D_TRY(check_fits(*index, *relation, op));
  const auto& attributes = relation->tuple_type().attributes();
  const auto found = std::ranges::find(attributes, index->attribute(), &TypeExpr::Attribute::name);
  if (found == attributes.end())
    return Error{ErrorCode::type_error, "{}: the relation has no attribute '{}'", op, index->attribute()};
  return IndexSearch{index, relation, static_cast<std::size_t>(found - attributes.begin())};
}

/// The tuples whose indexed geometry meets that of the window.
TupleStreamPtr meeting(TupleStreamPtr candidates, std::size_t attribute, const ResolvedCall& predicate,
                       const Value& window, Context& context) {
  const auto condition = [=](const Tuple& tuple, Context& own) -> Result<bool> {
    std::array values{tuple.attributes[attribute], window};
    A3D_ASSIGN(const Value result, Registry::call(predicate, values, own));
    return is_true(result);
  };
  return parallel_filter(std::move(candidates), condition, context);
}

/// How the tuples are found whose boxes meet a window.
struct WindowPlan {
  TypeExpr tuple;
  std::optional<ResolvedCall> predicate;  ///< that their geometry must fulfil with that of the window
  std::vector<bool> read;
};

Result<Datum> tuples_in_window(const WindowPlan& plan, const std::vector<Datum>& given, Context& context) {
  A3D_ASSIGN(const IndexSearch search, index_search(given, "windowintersects"));
  const Value& window = given[2].value();
  A3D_ASSIGN(const auto ids, ids_in_window(*search.index, window_of(window)));
  TupleList list{std::vector<TupleId>(ids.begin(), ids.end()), plan.read, {}, {}};
  list.read[search.attribute] = true;
  list.fits = [attribute = search.attribute, box = window_of(window)](const Batch& batch, std::size_t row) {
    return window_of(batch.columns[attribute]->value(row)).intersects(box);
  };
  TupleStreamPtr tuples = found_tuples(search.relation, search.index, std::move(list), context);
  if (!plan.predicate) return Datum{std::move(tuples)};
  A3D_ASSIGN(const Value loaded, window.loaded());
  return Datum{meeting(std::move(tuples), search.attribute, *plan.predicate, loaded, context)};
}

BoundOperator window_operator(const WindowPlan& plan) {
  return {TypeExpr::stream(plan.tuple),
          [plan](const std::vector<Datum>& given, Context& context) { return tuples_in_window(plan, given, context); },
          FindsTuples{[plan](std::vector<bool> read) {
            return window_operator({plan.tuple, plan.predicate, std::move(read)});
          }},
          text_of_read(plan.tuple, plan.read)};
}

TypeMapping map_windowintersects(const Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check("windowintersects", arguments);
    A3D_ASSIGN(const TypeExpr tuple, indexed_relation(check));
    A3D_TRY(check.argument_count(3, 4));
    A3D_TRY(check_window(registry, check, 2));
    std::optional<ResolvedCall> predicate;
    if (check.count() == 4) {
      A3D_TRY(asks_for_exact(check, 3));
      const std::array types{check[0].type.arguments()[1], check[2].type};
      A3D_ASSIGN(predicate, registry.resolve(*registry.find_operator("intersects"), types));
    }
    return window_operator({tuple, std::move(predicate), std::vector<bool>(tuple.attributes().size(), true)});
  };
}

TypeMapping map_window_ids(const algebra3d::Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check("windowintersectsS", arguments);
    A3D_TRY(index_operand(check, 0));
    A3D_TRY(check_window(registry, check, 1));
    return BoundOperator{
        TypeExpr::stream(TypeExpr::tuple({{"Id", TypeExpr("tid")}})),
        [](std::vector<Datum> given, Context&) -> Result<Datum> {
          A3D_ASSIGN(auto found, ids_in_window(*given[0].index(), window_of(given[1].value())));
          return Datum{make_stream([ids = one_by_one(std::move(found))]() mutable -> Result<TuplePtr> {
            A3D_ASSIGN(const auto id, ids());
            if (!id) return TuplePtr();
            return TuplePtr(std::make_shared<const Tuple>(Tuple{{id_value(static_cast<TupleId>(*id))}}));
          })};
        }};
  };
}

TypeMapping map_nodes() {
  return [](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check("nodes", arguments);
    A3D_TRY(index_operand(check, 0));
    return BoundOperator{
        TypeExpr::stream(TypeExpr::tuple({{"Level", TypeExpr("int")},
                                          {"Leaf", TypeExpr("bool")},
                                          {"Members", TypeExpr("int")},
                                          {"Box", TypeExpr("rect3")}})),
        [](std::vector<Datum> given, Context&) -> Result<Datum> {
          A3D_ASSIGN(auto nodes, given[0].index()->ask([](const Tree& tree) { return rtree::nodes_of(tree); }));
          return Datum{make_stream([nodes = std::move(nodes), next = std::size_t{0}]() mutable -> Result<TuplePtr> {
            if (next == nodes.size()) return TuplePtr();
            const rtree::NodeSummary& node = nodes[next++];
            return TuplePtr(std::make_shared<const Tuple>(
                Tuple{{Value::of(std::int64_t{node.depth}), Value::of(node.is_leaf),
                       Value::of(static_cast<std::int64_t>(node.member_count)), Value::of(node.box)}}));
          })};
        }};
  };
}

/// The arguments of distancescan after the value.
struct ScanOptions {
  bool has_limit = false;  ///< at place 3
  bool is_exact = false;
};

Result<ScanOptions> scan_options(const Registry& registry, const MappingCheck& check) {
  ScanOptions options;
  A3D_TRY(check.argument_count(3, 5));
  A3D_TRY(check_window(registry, check, 2));
  options.has_limit = check.count() == 5 || (check.count() == 4 && check[3].type.is("int"));
  if (options.has_limit) A3D_TRY(check.type(3, "int"));
  const std::size_t word = options.has_limit ? 4 : 3;
  if (word == check.count()) return options;
  if (word == 3 && !check[3].type.is("string") && !check[3].type.is("text"))
    return check.expected("int", check[3].type);
  A3D_ASSIGN(options.is_exact, asks_for_exact(check, word));
  const std::array types{check[0].type.arguments()[1], check[2].type};
  const auto distance = registry.resolve(*registry.find_operator("distance"), types);
  if (!distance) return distance.error();
  return options;
}

/// The largest number of tuples that a scan returns: none for an undefined limit.
std::uint64_t scan_limit(const std::vector<Datum>& given, const ScanOptions& options) {
  if (!options.has_limit) return std::numeric_limits<std::uint64_t>::max();
  const Value& limit = given[3].value();
  return limit.is_defined() ? static_cast<std::uint64_t>(std::max<std::int64_t>(0, limit.get<std::int64_t>())) : 0;
}

TypeMapping map_distancescan(const Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check("distancescan", arguments);
    A3D_ASSIGN(const TypeExpr tuple, indexed_relation(check));
    A3D_ASSIGN(const ScanOptions options, scan_options(registry, check));
    return BoundOperator{
        TypeExpr::stream(tuple), [options](std::vector<Datum> given, Context& context) -> Result<Datum> {
          A3D_ASSIGN(IndexSearch search, index_search(given, "distancescan"));
          const Box3 box = window_of(given[2].value());
          std::uint64_t left = box.is_empty() ? 0 : scan_limit(given, options);
          if (options.is_exact && left > 0) {
            A3D_ASSIGN(const Value to, given[2].value().loaded());
            return Datum{exact_distance_scan(std::move(search), to, left, context)};
          }
          using Neighbor = NearestEntries::Neighbor;
          return Datum{fetched(
              search.relation, search.index,
              [nearest = NearestEntries(search.index, box), left]() mutable -> Result<std::optional<Neighbor>> {
                if (left == 0) return std::optional<Neighbor>();
                --left;
                return nearest.next();
              },
              &Neighbor::payload,
              [attribute = search.attribute, box](const Tuple& own, const Neighbor& found) {
                return has_box_at(own.attributes[attribute], box, found.distance);
              })};
        }};
  };
}

constexpr std::string_view kTwoBoxes =
    "[const rel(tuple([No: int, B: rect3])) value ((1 (0 1 0 1 0 1)) (2 (5 6 0 1 0 1)) (3 undefined))] feed ";

}  // namespace

void register_indexes(algebra3d::OperatorGroup& group) {
  const std::string boxes(kTwoBoxes);
  group.add({
      .name = "creatertree",
      .syntax = "_ creatertree[attribute]",
      .doc = "An R-tree over the boxes of a spatial attribute.",
      .detail = "Stored with `let`, an index on a stored relation is a definition and is updated with the relation; an "
                "index on a stream is a frozen copy. The stream has the ids in an attribute of type tid, or its tuples "
                "come straight from a stored relation. Undefined and empty values have no box and are left out.",
      .cost = algebra3d::Cost::sorting,
      .stream = stream_operator(map_creatertree(group.registry(), "creatertree")),
      .signatures = {"(rel(tuple) NAME) -> rtree3(tuple SPATIAL3D)", "(stream(tuple) NAME) -> rtree3(tuple SPATIAL3D)"},
      .handles_undefined = true,
      .query_examples =
          {{"Boxes creatertree[B]", "(Boxes B 2)"},
           {"Boxes feed filter[isdefined(.B)] creatertree[B]", "(frozen B 2)"},
           {"Boxes feed extend[Id: tupleid(.)] creatertree[B] Boxes windowintersects[makePoint3D(5, 0, 0)] "
            "count",
            "1"}},
      .query_errors = {{"query " + boxes + "creatertree[No]",
                        "creatertree: expected an attribute of kind SPATIAL2D or SPATIAL3D, got int"},
                       {"query " + boxes + "creatertree[B]", "creatertree: the tuples have no ids"}},
  });
  group.add({
      .name = "bulkloadrtree",
      .syntax = "_ bulkloadrtree[attribute]",
      .doc = "An R-tree over the boxes of a spatial attribute of a stream, as by creatertree.",
      .detail = "The order of the stream does not matter here.",
      .cost = algebra3d::Cost::sorting,
      .stream = stream_operator(map_bulkloadrtree(group.registry())),
      .signatures = {"(stream(tuple) NAME) -> rtree3(tuple SPATIAL3D)"},
      .handles_undefined = true,
      .query_examples = {{"Boxes feed addid bulkloadrtree[B]", "(frozen B 2)"}},
      .query_errors = {{"query Boxes bulkloadrtree[B]",
                        "bulkloadrtree: expected a stream of tuples (write `feed` after the relation)"},
                       {"query " + boxes + "bulkloadrtree[B]", "bulkloadrtree: the tuples have no ids"}},
  });
  group.add({
      .name = "windowintersectsS",
      .syntax = "_ windowintersectsS[_]",
      .doc = "The ids of the tuples whose indexed box meets the window, ascending, as tuples with the attribute Id.",
      .detail = "Use gettuples to fetch the tuples. The window is a rect3 or the box of any spatial value.",
      .stream = stream_operator(map_window_ids(group.registry())),
      .signatures = {"(rtree3(tuple SPATIAL3D) SPATIAL3D) -> stream(tuple((Id tid)))"},
      .handles_undefined = true,
      .query_examples = {{"Boxes_B windowintersectsS[rectangle3(0, 9, 0, 9, 0, 9)] consume", "((1) (2))"},
                         {"Boxes_B windowintersectsS[[const rect3 value undefined]] count", "0"}},
      .query_errors = {{"query 5 windowintersectsS[6]", "windowintersectsS: expected an R-tree, got int"},
                       {"query Boxes_B windowintersectsS[6] count",
                        "windowintersectsS: expected a rect3 or another spatial value, got int"}},
  });
  group.add({
      .name = "nodes",
      .syntax = "_ nodes",
      .doc = "The nodes of an R-tree as tuples (Level, Leaf, Members, Box), a parent before its children.",
      .detail =
          "Level is 0 for the root; Members is the number of children, or of entries of a leaf; Box is the smallest "
          "box around all entries below. An empty tree has no nodes.",
      .stream = stream_operator(map_nodes()),
      .signatures = {"(rtree3(tuple SPATIAL3D)) -> stream(tuple((Level int) (Leaf bool) (Members int) (Box rect3)))"},
      .handles_undefined = true,
      .query_examples = {{"Boxes_B nodes consume", "((0 TRUE 2 (0.0 6.0 0.0 1.0 0.0 1.0)))"},
                         {"Boxes feed filter[.No > 5] creatertree[B] nodes count", "0"}},
      .query_errors = {{"query 5 nodes", "nodes: expected an R-tree, got int"}},
  });
  group.add({
      .name = "windowintersects",
      .syntax = "_ _ windowintersects[_ ...]",
      .doc = "The tuples of a relation whose indexed box meets the window, in the order of their ids; with \"exact\" "
             "those whose geometry meets that of the window.",
      .detail =
          "The window is a rect3 or the box of any spatial value. Touching counts. Undefined and empty windows meet "
          "nothing. With \"exact\" the result is that of `intersects`, asked only where boxes meet.",
      .stream = stream_operator(map_windowintersects(group.registry())),
      .signatures = {"(rtree3(tuple SPATIAL3D) rel(tuple) SPATIAL3D) -> stream(tuple)",
                     "(rtree3(tuple SPATIAL3D) rel(tuple) SPATIAL3D string) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"Boxes_B Boxes windowintersects[rectangle3(0, 2, 0, 2, 0, 2)] project[No] consume", "((1))"},
                         {"Boxes_B Boxes windowintersects[createSphere(makePoint3D(2, 2, 0), 1, 8)] count", "1"},
                         {"Boxes_B Boxes windowintersects[createSphere(makePoint3D(2, 2, 0), 1, 8), \"exact\"] count",
                          "0"},
                         {"Boxes_B Boxes windowintersects[[const rect3 value undefined]] count", "0"}},
      .query_errors = {{"query 5 6 windowintersects[7]", "windowintersects: expected an R-tree, got int"},
                       {"query Boxes_B Boxes windowintersects[makePoint3D(5, 0, 0), \"fast\"] count",
                        "windowintersects: expected the constant \"exact\""}},
  });
  group.add({
      .name = "distancescan",
      .syntax = "_ _ distancescan[_ ...]",
      .doc = "The tuples of a relation by ascending distance of their indexed boxes from the box of a value; if k is "
             "given, only the first k.",
      .detail =
          "Distances of boxes are compared as they are rounded to doubles. Equal distances: by tuple id. No tuples for "
          "an undefined or empty value. With \"exact\" the distance is that of the geometry, as by `distance`, "
          "compared "
          "before it is rounded.",
      .sources = {"hjaltason1999"},
      .stream = stream_operator(map_distancescan(group.registry())),
      .signatures = {"(rtree3(tuple SPATIAL3D) rel(tuple) SPATIAL3D) -> stream(tuple)",
                     "(rtree3(tuple SPATIAL3D) rel(tuple) SPATIAL3D int) -> stream(tuple)",
                     "(rtree3(tuple SPATIAL3D) rel(tuple) SPATIAL3D string) -> stream(tuple)",
                     "(rtree3(tuple SPATIAL3D) rel(tuple) SPATIAL3D int string) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"Boxes_B Boxes distancescan[makePoint3D(9, 0, 0), 1] project[No] consume", "((2))"},
                         {"Boxes_B Boxes distancescan[makePoint3D(0, 0, 0)] project[No] consume", "((1) (2))"},
                         {"Boxes_B Boxes distancescan[makePoint3D(4, 0, 0), 1, \"exact\"] project[No] consume",
                          "((2))"},
                         {"Boxes_B Boxes distancescan[[const point3d value undefined]] count", "0"}},
      .query_errors = {{"query 5 6 distancescan[7]", "distancescan: expected an R-tree, got int"},
                       {"query Boxes_B Boxes distancescan[makePoint3D(0, 0, 0), \"nearly\"] count",
                        "distancescan: expected the constant \"exact\""}},
  });
}

}  // namespace queries
