// creatertree, windowintersects, distancescan, itSpatialJoin: what boxes make fast.
#include <algorithm>
#include <limits>

#include "algebra3d/types/scalars.h"
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"
#include "queries/streams/spatial_index.h"

namespace queries {
namespace {

using algebra3d::Box3;
using Tree = SpatialIndex::Tree;
using Entry = rtree::Entry<std::uint64_t>;

TypeExpr index_type(const TypeExpr& tuple, const TypeExpr& key) {
  return {"rtree3", {tuple, key, "FALSE"}};
}

bool is_spatial(const algebra3d::Registry& registry, const TypeExpr& type) {
  const algebra3d::Type* known = registry.find_type(type.name());
  return known != nullptr && known->is_spatial();
}

Result<std::size_t> spatial_attribute(const algebra3d::Registry& registry, const MappingCheck& check,
                                      std::size_t position, const TypeExpr& tuple) {
  ASSIGN_OR_RETURN(const std::size_t index, check.attribute(position, tuple));
  const TypeExpr& type = tuple.attributes()[index].type;
  if (!is_spatial(registry, type)) return check.expected("an attribute of kind SPATIAL3D", type);
  return index;
}

/// The tuple type that an index is for.
Result<TypeExpr> index_operand(const MappingCheck& check, std::size_t position) {
  const TypeExpr& type = check[position].type;
  if (type.is("rtree3") && !type.arguments().empty()) return type.arguments()[0];
  return check.expected("an R-tree", type);
}

std::vector<Entry> entries_of(const std::vector<TuplePtr>& tuples, std::size_t attribute, bool by_position) {
  std::vector<Entry> entries;
  entries.reserve(tuples.size());
  for (std::size_t position = 0; position < tuples.size(); ++position) {
    const Value& value = tuples[position]->attributes[attribute];
    if (!value.is_defined()) continue;
    const std::uint64_t payload = by_position ? position : static_cast<std::uint64_t>(tuples[position]->id);
    if (const Box3 box = value.header().box; !box.is_empty()) entries.push_back({box, payload});
  }
  return entries;
}

Result<Datum> create_index(const Datum& source, std::size_t attribute, const std::string& attribute_name,
                           Context& context) {
  std::string relation;
  if (const auto* stored = std::get_if<RelationPtr>(&source.content)) relation = (*stored)->name();
  ASSIGN_OR_RETURN(const TupleStreamPtr stream, tuples_of(source));
  ASSIGN_OR_RETURN(const auto tuples, materialise(*stream, context));
  if (std::ranges::any_of(tuples, [](const TuplePtr& tuple) { return tuple->id == 0; }))
    return Error{
        ErrorCode::wrong_usage,
        "creatertree: the tuples have no ids; build the index on a stored relation, or on a filtered scan of one"};
  auto tree = std::make_shared<Tree>(Tree::bulk_load(entries_of(tuples, attribute, false)));
  return Datum{std::make_shared<SpatialIndex>(std::move(relation), attribute_name, std::move(tree))};
}

TypeMapping map_creatertree(const algebra3d::Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<Plan> {
    const MappingCheck check("creatertree", arguments);
    ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream_or_relation(0));
    ASSIGN_OR_RETURN(const std::size_t attribute, spatial_attribute(registry, check, 1, tuple));
    const auto& [name, type] = tuple.attributes()[attribute];
    return Plan{index_type(tuple, type), [attribute, key = name](std::vector<Datum> given, Context& context) {
                  return create_index(given[0], attribute, key, context);
                }};
  };
}

/// The index fits the relation: made for its tuples and, if it follows a stored relation, for this one.
Status check_fits(const SpatialIndex& index, const Relation& relation, std::string_view op) {
  if (!index.is_definition() || index.relation() == relation.name()) return {};
  return Error{ErrorCode::wrong_usage, "{}: the index is on the relation '{}', not on '{}'", op, index.relation(),
               relation.name()};
}

Result<TypeExpr> indexed_relation(const MappingCheck& check) {
  ASSIGN_OR_RETURN(const TypeExpr indexed, index_operand(check, 0));
  ASSIGN_OR_RETURN(TypeExpr tuple, check.relation(1));
  if (!(indexed == tuple))
    return check.error("expected an index on the relation's tuples, got " + check[0].type.text());
  return tuple;
}

Status check_window(const algebra3d::Registry& registry, const MappingCheck& check) {
  if (is_spatial(registry, check[2].type)) return {};
  return check.expected("a rect3 or another value of kind SPATIAL3D", check[2].type);
}

Box3 window_of(const Value& value) {
  return value.is_defined() ? value.header().box : Box3{};
}

/// Fetches tuples by id, skipping ids that a frozen index still holds and the relation does not.
template <typename NextId>
TupleStreamPtr fetched(RelationPtr relation, NextId next_id) {
  return make_stream([relation = std::move(relation), next_id = std::move(next_id)]() mutable -> Result<TuplePtr> {
    while (const auto id = next_id()) {
      ASSIGN_OR_RETURN(TuplePtr tuple, relation->fetch(static_cast<TupleId>(*id)));
      if (tuple != nullptr) return tuple;
    }
    return TuplePtr();
  });
}

// Ids in ascending order, so that the result does not depend on how the tree grew, and pages are read in order.
std::vector<std::uint64_t> ids_in_window(const Tree& tree, const Box3& window) {
  std::vector<std::uint64_t> ids;
  if (window.is_empty()) return ids;
  for (const std::uint64_t id : tree.window(window)) ids.push_back(id);
  std::ranges::sort(ids);
  return ids;
}

TypeMapping map_windowintersects(const algebra3d::Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<Plan> {
    const MappingCheck check("windowintersects", arguments);
    ASSIGN_OR_RETURN(const TypeExpr tuple, indexed_relation(check));
    RETURN_IF_ERROR(check_window(registry, check));
    return Plan{
        TypeExpr::stream(tuple), [](std::vector<Datum> given, Context&) -> Result<Datum> {
          const auto& index = given[0].index();
          RETURN_IF_ERROR(check_fits(*index, *given[1].relation(), "windowintersects"));
          auto ids = ids_in_window(index->tree(), window_of(given[2].value()));
          return Datum{fetched(given[1].relation(), [ids = std::move(ids), position = std::size_t{0}]() mutable {
            return position == ids.size() ? std::nullopt : std::optional(ids[position++]);
          })};
        }};
  };
}

TypeMapping map_distancescan(const algebra3d::Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<Plan> {
    const MappingCheck check("distancescan", arguments);
    ASSIGN_OR_RETURN(const TypeExpr tuple, indexed_relation(check));
    RETURN_IF_ERROR(check.argument_count(3, 4));
    RETURN_IF_ERROR(check_window(registry, check));
    if (check.count() == 4) RETURN_IF_ERROR(check.type(3, "int"));
    return Plan{TypeExpr::stream(tuple), [](std::vector<Datum> given, Context&) -> Result<Datum> {
                  const auto index = given[0].index();
                  RETURN_IF_ERROR(check_fits(*index, *given[1].relation(), "distancescan"));
                  const Box3 box = window_of(given[2].value());
                  std::int64_t left = std::numeric_limits<std::int64_t>::max();
                  if (given.size() == 4)
                    left = given[3].value().is_defined() ? given[3].value().get<std::int32_t>() : 0;
                  if (box.is_empty()) left = 0;
                  return Datum{fetched(
                      given[1].relation(),
                      [index, left, cursor = index->tree().nearest(box)]() mutable -> std::optional<std::uint64_t> {
                        if (left-- <= 0) return std::nullopt;
                        const auto next = cursor.next();
                        return next ? std::optional(next->payload) : std::nullopt;
                      })};
                }};
  };
}

// The tree is built on the first stream; the second one passes by, each tuple asking for its partners.
class SpatialJoin {
 public:
  SpatialJoin(std::vector<TuplePtr> first, std::size_t first_key, TupleStreamPtr second, std::size_t second_key)
      : first_(std::move(first)),
        tree_(Tree::bulk_load(entries_of(first_, first_key, true))),
        second_(std::move(second)),
        second_key_(second_key) {}

  Result<TuplePtr> next(const Context& context) {
    while (position_ == partners_.size()) {
      if (++steps_ % 256 == 0) RETURN_IF_ERROR(context.check_cancelled());
      ASSIGN_OR_RETURN(current_, second_->next());
      if (current_ == nullptr) return TuplePtr();
      partners_ = ids_in_window(tree_, window_of(current_->attributes[second_key_]));
      position_ = 0;
    }
    return concatenated(*first_[partners_[position_++]], *current_);
  }

 private:
  std::vector<TuplePtr> first_;
  Tree tree_;
  TupleStreamPtr second_;
  std::size_t second_key_;
  TuplePtr current_;
  std::vector<std::uint64_t> partners_;
  std::size_t position_ = 0;
  std::uint32_t steps_ = 0;
};

TypeMapping map_spatial_join(const algebra3d::Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<Plan> {
    const MappingCheck check("itSpatialJoin", arguments);
    ASSIGN_OR_RETURN(const TypeExpr left, check.stream(0));
    ASSIGN_OR_RETURN(const TypeExpr right, check.stream(1));
    RETURN_IF_ERROR(check.argument_count(4, 7));
    for (std::size_t place = 4; place < check.count(); ++place) RETURN_IF_ERROR(check.type(place, "int"));
    ASSIGN_OR_RETURN(const std::size_t left_key, spatial_attribute(registry, check, 2, left));
    ASSIGN_OR_RETURN(const std::size_t right_key, spatial_attribute(registry, check, 3, right));
    ASSIGN_OR_RETURN(const TypeExpr joined, check.concatenated(left, right));
    return Plan{TypeExpr::stream(joined), [=](std::vector<Datum> given, Context& context) -> Result<Datum> {
                  ASSIGN_OR_RETURN(auto first, materialise(*given[0].tuples(), context));
                  auto join = std::make_shared<SpatialJoin>(std::move(first), left_key, given[1].tuples(), right_key);
                  return Datum{make_stream([join, &context]() { return join->next(context); })};
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
      .detail =
          "Stored with `let`, an index on a stored relation is remembered as a definition and follows the relation's "
          "changes; one on a stream is a frozen copy. Undefined and empty values have no box and are left out.",
      .stream = stream_operator(map_creatertree(registry)),
      .signatures = {"(rel(tuple) NAME) -> rtree3(tuple SPATIAL3D)", "(stream(tuple) NAME) -> rtree3(tuple SPATIAL3D)"},
      .handles_undefined = true,
      .examples = {{"Boxes creatertree[B]", "(Boxes B 2)"},
                   {"Boxes feed filter[isdefined(.B)] creatertree[B]", "(frozen B 2)"}},
      .errors = {{"query " + boxes + "creatertree[No]",
                  "creatertree: expected an attribute of kind SPATIAL3D, got int"},
                 {"query " + boxes + "creatertree[B]", "creatertree: the tuples have no ids"}},
  });
  registry.add({
      .name = "windowintersects",
      .syntax = "_ _ windowintersects[_]",
      .doc = "The tuples of a relation whose indexed box meets the window, in the order of their ids.",
      .detail =
          "The window is a rect3 or any spatial value, which stands for its box. Touching counts. Undefined and empty "
          "windows meet nothing.",
      .stream = stream_operator(map_windowintersects(registry)),
      .signatures = {"(rtree3(tuple SPATIAL3D) rel(tuple) SPATIAL3D) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{"Boxes_B Boxes windowintersects[rectangle3(0, 2, 0, 2, 0, 2)] project[No] consume", "((1))"},
                   {"Boxes_B Boxes windowintersects[[const rect3 value undefined]] count", "0"}},
      .errors = {{"query 5 6 windowintersects[7]", "windowintersects: expected an R-tree, got int"}},
  });
  registry.add({
      .name = "distancescan",
      .syntax = "_ _ distancescan[_ ...]",
      .doc = "The tuples of a relation by growing distance of their indexed boxes from the box of a value; the first k "
             "only "
             "if k is given.",
      .detail = "Equal distances: by tuple id. An undefined or empty value gives nothing.",
      .stream = stream_operator(map_distancescan(registry)),
      .signatures = {"(rtree3(tuple SPATIAL3D) rel(tuple) SPATIAL3D) -> stream(tuple)",
                     "(rtree3(tuple SPATIAL3D) rel(tuple) SPATIAL3D int) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{"Boxes_B Boxes distancescan[makePoint3D(9, 0, 0), 1] project[No] consume", "((2))"},
                   {"Boxes_B Boxes distancescan[makePoint3D(0, 0, 0)] project[No] consume", "((1) (2))"},
                   {"Boxes_B Boxes distancescan[[const point3d value undefined]] count", "0"}},
      .errors = {{"query 5 6 distancescan[7]", "distancescan: expected an R-tree, got int"}},
  });
  registry.add({
      .name = "itSpatialJoin",
      .syntax = "_ _ itSpatialJoin[attribute, attribute ...]",
      .doc = "The pairs of tuples of both streams whose boxes meet, in the order of the second stream.",
      .detail = "The first stream is held in memory with an R-tree over it. Touching counts. Up to three ints (node "
                "sizes and "
                "memory) are accepted and not needed.",
      .stream = stream_operator(map_spatial_join(registry)),
      .signatures = {"(stream(tuple) stream(tuple) NAME NAME) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{boxes + "{a} " + boxes + "{b} itSpatialJoin[B_a, B_b] project[No_a, No_b] consume",
                    "((1 1) (2 2))"}},
      .errors = {{"query " + boxes + boxes + "itSpatialJoin[B, B] count",
                  "itSpatialJoin: the attribute 'No' would stand twice"},
                 {"query " + boxes + "{a} " + boxes + "{b} itSpatialJoin[No_a, B_b] count",
                  "itSpatialJoin: expected an attribute of kind SPATIAL3D, got int"}},
  });
}

}  // namespace queries
