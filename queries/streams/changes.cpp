// inserttuple, deletesearch: changes of stored relations.
#include <limits>
#include <unordered_map>

#include "algebra3d/types/scalars.h"
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"

namespace queries {
namespace {

TypeExpr with_id(const TypeExpr& tuple) {
  auto attributes = tuple.attributes();
  attributes.push_back({"TID", "int"});
  return TypeExpr::tuple(std::move(attributes));
}

Value id_value(TupleId id) {
  if (id > std::numeric_limits<std::int32_t>::max()) return Value(algebra3d::TypeOf<std::int32_t>::type());
  return Value::of<std::int32_t>(static_cast<std::int32_t>(id));
}

TuplePtr tuple_with_id(const Tuple& tuple, TupleId id) {
  Tuple result = tuple;
  result.attributes.push_back(id_value(id));
  return std::make_shared<const Tuple>(std::move(result));
}

Value promoted(const Value& value, bool to_real) {
  if (!to_real) return value;
  if (!value.is_defined()) return Value(algebra3d::TypeOf<double>::type());
  return Value::of<double>(value.get<std::int32_t>());
}

Result<Plan> map_inserttuple(std::span<const ArgumentType> arguments) {
  const MappingCheck check("inserttuple", arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.relation(0));
  const auto& attributes = tuple.attributes();
  if (check.count() != attributes.size() + 1)
    return check.error(
        fmt::format("expected {} values, one per attribute, got {}", attributes.size(), check.count() - 1));
  std::vector<bool> to_real;
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    const TypeExpr& given = check[i + 1].type;
    to_real.push_back(attributes[i].type.is("real") && given.is("int"));
    if (!to_real.back() && !(given == attributes[i].type))
      return check.expected(attributes[i].type.text() + " for the attribute '" + attributes[i].name + "'", given);
  }
  return Plan{TypeExpr::stream(with_id(tuple)), [to_real](std::vector<Datum> given, Context&) -> Result<Datum> {
                Tuple row;
                for (std::size_t i = 0; i < to_real.size(); ++i)
                  row.attributes.push_back(promoted(given[i + 1].value(), to_real[i]));
                return Datum{make_stream([relation = given[0].relation(), row = std::move(row),
                                          is_done = false]() mutable -> Result<TuplePtr> {
                  if (is_done) return TuplePtr();
                  is_done = true;
                  ASSIGN_OR_RETURN(const TupleId id, relation->insert(row));
                  return tuple_with_id(row, id);
                })};
              }};
}

// For spatial values box and count, so that unequal tuples are told apart without reading geometry.
std::size_t quick_hash(const Tuple& tuple) {
  std::size_t result = 0;
  for (const Value& value : tuple.attributes) {
    std::size_t own = 0;
    if (value.is_defined() && value.type().is_spatial()) {
      const auto header = value.header();
      own = std::hash<double>()(header.box.min.x) ^ (std::hash<double>()(header.box.max.y) << 1) ^ header.size;
    } else {
      own = hash(value);
    }
    result = result * 1'000'003 + own;
  }
  return result;
}

Result<bool> are_equal(const Tuple& a, const Tuple& b) {
  for (std::size_t i = 0; i < a.attributes.size(); ++i) {
    if (a.attributes[i].is_defined() != b.attributes[i].is_defined()) return false;
    ASSIGN_OR_RETURN(const Value left, a.attributes[i].loaded());
    ASSIGN_OR_RETURN(const Value right, b.attributes[i].loaded());
    if (compare(left, right) != 0) return false;
  }
  return true;
}

Result<Tuple> loaded_tuple(const Tuple& tuple) {
  Tuple result;
  result.id = tuple.id;
  for (const Value& value : tuple.attributes) {
    ASSIGN_OR_RETURN(Value loaded, value.loaded());
    result.attributes.push_back(std::move(loaded));
  }
  return result;
}

// Finds first and deletes then: the relation must not change while it is being read. The tuples that are passed on are
// loaded before their geometry goes.
Result<std::vector<TuplePtr>> delete_equal(TupleStream& wanted, Relation& relation, Context& context) {
  std::unordered_map<std::size_t, std::vector<TuplePtr>> by_hash;
  RETURN_IF_ERROR(for_each_tuple(wanted, context, [&](const TuplePtr& tuple) -> Status {
    by_hash[quick_hash(*tuple)].push_back(tuple);
    return {};
  }));
  std::vector<TuplePtr> doomed;
  ASSIGN_OR_RETURN(const TupleStreamPtr all, relation.scan());
  RETURN_IF_ERROR(for_each_tuple(*all, context, [&](const TuplePtr& tuple) -> Status {
    const auto candidates = by_hash.find(quick_hash(*tuple));
    if (candidates == by_hash.end()) return {};
    for (const TuplePtr& candidate : candidates->second) {
      ASSIGN_OR_RETURN(const bool equal, are_equal(*candidate, *tuple));
      if (!equal) continue;
      ASSIGN_OR_RETURN(Tuple loaded, loaded_tuple(*tuple));
      doomed.push_back(std::make_shared<const Tuple>(std::move(loaded)));
      break;
    }
    return {};
  }));
  for (const TuplePtr& tuple : doomed) RETURN_IF_ERROR(relation.erase(tuple->id));
  return doomed;
}

Result<Plan> map_deletesearch(std::span<const ArgumentType> arguments) {
  const MappingCheck check("deletesearch", arguments);
  ASSIGN_OR_RETURN(const TypeExpr wanted, check.stream(0));
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.relation(1));
  if (!(wanted == tuple)) return check.expected("a stream of " + tuple.text(), wanted);
  return Plan{TypeExpr::stream(with_id(tuple)), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                return Datum{make_stream([stream = given[0].tuples(), relation = given[1].relation(), &context,
                                          deleted = std::optional<std::vector<TuplePtr>>(),
                                          position = std::size_t{0}]() mutable -> Result<TuplePtr> {
                  if (!deleted) {
                    ASSIGN_OR_RETURN(deleted, delete_equal(*stream, *relation, context));
                  }
                  if (position == deleted->size()) return TuplePtr();
                  const TuplePtr& next = (*deleted)[position++];
                  return tuple_with_id(*next, next->id);
                })};
              }};
}

}  // namespace

void register_changes(algebra3d::Registry& registry) {
  registry.add({
      .name = "inserttuple",
      .syntax = "_ inserttuple[_ ...]",
      .doc = "Inserts one tuple into a stored relation and gives it with its id as TID; takes effect when consumed or "
             "counted.",
      .detail = "One value per attribute, in order. Indexes on the relation follow.",
      .stream = stream_operator(map_inserttuple),
      .signatures = {"(rel(tuple) DATA ...) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{"Boxes inserttuple[4, rectangle3(0, 1, 0, 1, 0, 1)] consume", "((4 (0.0 1.0 0.0 1.0 0.0 1.0) 4))"},
                   {"Boxes inserttuple[5, [const rect3 value undefined]] count", "1"}},
      .errors = {{"query [const rel(tuple([A: int])) value ()] inserttuple[1, 2] count",
                  "inserttuple: expected 1 values, one per attribute, got 2"},
                 {"query [const rel(tuple([A: int])) value ()] inserttuple[TRUE] count",
                  "inserttuple: expected int for the attribute 'A', got bool"},
                 {"query [const rel(tuple([A: int])) value ()] inserttuple[1] count",
                  "only a relation that is stored as an object can be changed"}},
  });
  registry.add({
      .name = "deletesearch",
      .syntax = "_ _ deletesearch",
      .doc = "Deletes every tuple of a stored relation that equals one of the stream, and gives the deleted ones with "
             "their ids.",
      .detail = "The stream is read to its end first. Indexes on the relation follow. Undefined equals undefined here.",
      .stream = stream_operator(map_deletesearch),
      .signatures = {"(stream(tuple) rel(tuple)) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{"Boxes feed filter[.No = 1] Boxes deletesearch project[No, TID] consume", "((1 1))"},
                   {"Boxes feed filter[not(isdefined(.B))] Boxes deletesearch count", "1"}},
      .errors = {{"query intstream(1, 2) transformstream [const rel(tuple([A: int])) value ()] deletesearch count",
                  "deletesearch: expected a stream of (tuple ((A int))), got (tuple ((Elem int)))"}},
  });
}

}  // namespace queries
