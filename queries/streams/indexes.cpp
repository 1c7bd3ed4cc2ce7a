// creatertree, bulkloadrtree, windowintersects, windowintersectsS, distancescan: R-trees on relations.
#include <algorithm>
#include <limits>

#include "algebra3d/registry/operator.h"
#include "algebra3d/types/scalars.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/index_operands.h"
#include "queries/streams/detail/spatial_attribute.h"
#include "queries/streams/mapping.h"
#include "queries/streams/spatial_index.h"

namespace queries {
namespace {

using algebra3d::Box3;
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

Result<Datum> create_index(const Datum& source, const IndexSource& from, std::size_t attribute, std::string_view op,
                           const Context& context) {
  std::vector<Entry> entries;
  ALGEBRA3D_RETURN_IF_ERROR(
      for_each_indexed(source, from.id_attribute, op, context, [&](const Tuple& tuple, TupleId id) -> Status {
        if (const Box3 box = window_of(tuple.attributes[attribute]); !box.is_empty())
          entries.push_back({box, static_cast<std::uint64_t>(id)});
        return {};
      }));
  auto tree = std::make_shared<Tree>(Tree::bulk_load(entries));
  return Datum{
      std::make_shared<SpatialIndex>(stored_name(source), from.given.attributes()[attribute].name, std::move(tree))};
}

TypeMapping map_creatertree(const algebra3d::Registry& registry, const char* op) {
  return [&registry, op](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check(op, arguments);
    ALGEBRA3D_ASSIGN_OR_RETURN(const IndexSource from, index_source(check));
    ALGEBRA3D_ASSIGN_OR_RETURN(const std::size_t attribute, spatial_attribute(registry, check, 1, from.given));
    return BoundOperator{index_type(from.indexed, from.given.attributes()[attribute].type),
                         [=](std::vector<Datum> given, Context& context) {
                           return create_index(given[0], from, attribute, op, context);
                         }};
  };
}

TypeMapping map_bulkloadrtree(const algebra3d::Registry& registry) {
  return [create = map_creatertree(registry, "bulkloadrtree")](
             std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    ALGEBRA3D_RETURN_IF_ERROR(MappingCheck("bulkloadrtree", arguments).stream(0));
    return create(arguments);
  };
}

Result<TypeExpr> indexed_relation(const MappingCheck& check) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const TypeExpr indexed, index_operand(check, 0));
  ALGEBRA3D_ASSIGN_OR_RETURN(TypeExpr tuple, check.relation(1));
  if (!(indexed == tuple))
    return check.error("expected an index on the relation's tuples, got " + check[0].type.text() +
                       "; to get the tuples of another relation by their ids use windowintersectsS and gettuples");
  return tuple;
}

Status check_window(const algebra3d::Registry& registry, const MappingCheck& check, std::size_t position) {
  if (is_spatial(registry, check[position].type)) return {};
  return check.expected("a rect3 or another spatial value", check[position].type);
}

TypeMapping map_windowintersects(const algebra3d::Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check("windowintersects", arguments);
    ALGEBRA3D_ASSIGN_OR_RETURN(const TypeExpr tuple, indexed_relation(check));
    ALGEBRA3D_RETURN_IF_ERROR(check_window(registry, check, 2));
    return BoundOperator{TypeExpr::stream(tuple), [](std::vector<Datum> given, Context&) -> Result<Datum> {
                           const auto& index = given[0].index();
                           ALGEBRA3D_RETURN_IF_ERROR(check_fits(*index, *given[1].relation(), "windowintersects"));
                           return Datum{fetched(given[1].relation(),
                                                one_by_one(ids_in_window(index->tree(), window_of(given[2].value()))))};
                         }};
  };
}

TypeMapping map_window_ids(const algebra3d::Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check("windowintersectsS", arguments);
    ALGEBRA3D_RETURN_IF_ERROR(index_operand(check, 0));
    ALGEBRA3D_RETURN_IF_ERROR(check_window(registry, check, 1));
    return BoundOperator{
        TypeExpr::stream(TypeExpr::tuple({{"Id", TypeExpr("tid")}})),
        [](std::vector<Datum> given, Context&) -> Result<Datum> {
          auto ids = one_by_one(ids_in_window(given[0].index()->tree(), window_of(given[1].value())));
          return Datum{make_stream([ids = std::move(ids)]() mutable -> Result<TuplePtr> {
            const auto id = ids();
            if (!id) return TuplePtr();
            return TuplePtr(std::make_shared<const Tuple>(Tuple{{id_value(static_cast<TupleId>(*id))}}));
          })};
        }};
  };
}

TypeMapping map_distancescan(const algebra3d::Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check("distancescan", arguments);
    ALGEBRA3D_ASSIGN_OR_RETURN(const TypeExpr tuple, indexed_relation(check));
    ALGEBRA3D_RETURN_IF_ERROR(check.argument_count(3, 4));
    ALGEBRA3D_RETURN_IF_ERROR(check_window(registry, check, 2));
    if (check.count() == 4) ALGEBRA3D_RETURN_IF_ERROR(check.type(3, "int"));
    return BoundOperator{
        TypeExpr::stream(tuple), [](std::vector<Datum> given, Context&) -> Result<Datum> {
          const auto index = given[0].index();
          ALGEBRA3D_RETURN_IF_ERROR(check_fits(*index, *given[1].relation(), "distancescan"));
          const Box3 box = window_of(given[2].value());
          std::int64_t left = std::numeric_limits<std::int64_t>::max();
          if (given.size() == 4) left = given[3].value().is_defined() ? given[3].value().get<std::int64_t>() : 0;
          if (box.is_empty()) left = 0;
          return Datum{
              fetched(given[1].relation(),
                      [index, left, cursor = index->tree().nearest(box)]() mutable -> std::optional<std::uint64_t> {
                        if (left-- <= 0) return std::nullopt;
                        const auto next = cursor.next();
                        return next ? std::optional(next->payload) : std::nullopt;
                      })};
        }};
  };
}

constexpr std::string_view kTwoBoxes =
    "[const rel(tuple([No: int, B: rect3])) value ((1 (0 1 0 1 0 1)) (2 (5 6 0 1 0 1)) (3 undefined))] feed ";

}  // namespace

void register_indexes(algebra3d::Registry& registry) {
  const std::string boxes(kTwoBoxes);
  registry.add({
      .name = "creatertree",
      .syntax = "_ creatertree[attribute]",
      .doc = "An R-tree over the boxes of a spatial attribute.",
      .detail = "Stored with `let`, an index on a stored relation is a definition and is updated with the relation; an "
                "index on a stream is a frozen copy. The stream has the ids in an attribute of type tid, or its tuples "
                "come straight from a stored relation. Undefined and empty values have no box and are left out.",
      .cost = algebra3d::Cost::sorting,
      .stream = stream_operator(map_creatertree(registry, "creatertree")),
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
  registry.add({
      .name = "bulkloadrtree",
      .syntax = "_ bulkloadrtree[attribute]",
      .doc = "An R-tree over the boxes of a spatial attribute of a stream, as by creatertree.",
      .detail = "The order of the stream does not matter here.",
      .cost = algebra3d::Cost::sorting,
      .stream = stream_operator(map_bulkloadrtree(registry)),
      .signatures = {"(stream(tuple) NAME) -> rtree3(tuple SPATIAL3D)"},
      .handles_undefined = true,
      .query_examples = {{"Boxes feed addid bulkloadrtree[B]", "(frozen B 2)"}},
      .query_errors = {{"query Boxes bulkloadrtree[B]",
                        "bulkloadrtree: expected a stream of tuples (write `feed` after the relation)"},
                       {"query " + boxes + "bulkloadrtree[B]", "bulkloadrtree: the tuples have no ids"}},
  });
  registry.add({
      .name = "windowintersectsS",
      .syntax = "_ windowintersectsS[_]",
      .doc = "The ids of the tuples whose indexed box meets the window, ascending, as tuples with the attribute Id.",
      .detail = "Use gettuples to fetch the tuples. The window is a rect3 or the box of any spatial value.",
      .stream = stream_operator(map_window_ids(registry)),
      .signatures = {"(rtree3(tuple SPATIAL3D) SPATIAL3D) -> stream(tuple((Id tid)))"},
      .handles_undefined = true,
      .query_examples = {{"Boxes_B windowintersectsS[rectangle3(0, 9, 0, 9, 0, 9)] consume", "((1) (2))"},
                         {"Boxes_B windowintersectsS[[const rect3 value undefined]] count", "0"}},
      .query_errors = {{"query 5 windowintersectsS[6]", "windowintersectsS: expected an R-tree, got int"},
                       {"query Boxes_B windowintersectsS[6] count",
                        "windowintersectsS: expected a rect3 or another spatial value, got int"}},
  });
  registry.add({
      .name = "windowintersects",
      .syntax = "_ _ windowintersects[_]",
      .doc = "The tuples of a relation whose indexed box meets the window, in the order of their ids.",
      .detail =
          "The window is a rect3 or the box of any spatial value. Touching counts. Undefined and empty windows meet "
          "nothing.",
      .stream = stream_operator(map_windowintersects(registry)),
      .signatures = {"(rtree3(tuple SPATIAL3D) rel(tuple) SPATIAL3D) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"Boxes_B Boxes windowintersects[rectangle3(0, 2, 0, 2, 0, 2)] project[No] consume", "((1))"},
                         {"Boxes_B Boxes windowintersects[[const rect3 value undefined]] count", "0"}},
      .query_errors = {{"query 5 6 windowintersects[7]", "windowintersects: expected an R-tree, got int"}},
  });
  registry.add({
      .name = "distancescan",
      .syntax = "_ _ distancescan[_ ...]",
      .doc = "The tuples of a relation by ascending distance of their indexed boxes from the box of a value; if k is "
             "given, only the first k.",
      .detail = "Equal distances: by tuple id. No tuples for an undefined or empty value.",
      .stream = stream_operator(map_distancescan(registry)),
      .signatures = {"(rtree3(tuple SPATIAL3D) rel(tuple) SPATIAL3D) -> stream(tuple)",
                     "(rtree3(tuple SPATIAL3D) rel(tuple) SPATIAL3D int) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"Boxes_B Boxes distancescan[makePoint3D(9, 0, 0), 1] project[No] consume", "((2))"},
                         {"Boxes_B Boxes distancescan[makePoint3D(0, 0, 0)] project[No] consume", "((1) (2))"},
                         {"Boxes_B Boxes distancescan[[const point3d value undefined]] count", "0"}},
      .query_errors = {{"query 5 6 distancescan[7]", "distancescan: expected an R-tree, got int"}},
  });
}

}  // namespace queries
