// inserttuple, insert, deletesearch, deletedirect, deletebyid: tuples come into stored relations and go.
#include <algorithm>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "algebra3d/values/types/tuple_number.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/batch_buffer.h"
#include "queries/streams/detail/block_join.h"
#include "queries/streams/detail/relation_changes.h"

namespace queries {
namespace {

Result<BoundOperator> map_inserttuple(std::span<const ArgumentType> arguments) {
  const MappingCheck check("inserttuple", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.relation(0));
  const auto& attributes = tuple.attributes();
  if (check.count() != attributes.size() + 1)
    return check.error(
        fmt::format("expected {} values, one per attribute, got {}", attributes.size(), check.count() - 1));
  std::vector<Conversion> conversions;
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    const TypeExpr& given = check[i + 1].type;
    const auto conversion = conversion_to(attributes[i].type, given);
    if (!conversion)
      return check.expected(attributes[i].type.text() + " for the attribute '" + attributes[i].name + "'", given);
    conversions.push_back(*conversion);
  }
  A3D_ASSIGN(const TypeExpr result, check.with_id(tuple));
  return BoundOperator{TypeExpr::stream(result), [conversions](std::vector<Datum> given, Context&) -> Result<Datum> {
                         Tuple row;
                         for (std::size_t i = 0; i < conversions.size(); ++i)
                           row.attributes.push_back(converted(given[i + 1].value(), conversions[i]));
                         return Datum{make_stream([relation = given[0].relation(), row = std::move(row),
                                                   is_done = false]() mutable -> Result<TuplePtr> {
                           if (is_done) return TuplePtr();
                           is_done = true;
                           A3D_ASSIGN(const TupleId id, relation->insert(row));
                           return tuple_with_id(row, id);
                         })};
                       }};
}

/// The type of the result of an operator whose operands are a stream and a relation of the same tuples.
Result<TypeExpr> changed_type(const MappingCheck& check) {
  A3D_ASSIGN(const TypeExpr given, check.stream(0));
  A3D_ASSIGN(const TypeExpr tuple, check.relation(1));
  if (!(given == tuple)) return check.expected("a stream of " + tuple.text(), given);
  return check.with_id(tuple);
}

/// The tuples that came into a relation, each with its id as a further attribute. They are inserted when the first one
/// is asked for.
class InsertedTuples final : public TupleStream {
 public:
  InsertedTuples(TupleStreamPtr tuples, RelationPtr relation, const Context& context)
      : tuples_(std::move(tuples)),
        relation_(std::move(relation)),
        context_(context),
        ids_(algebra3d::TypeOf<algebra3d::TupleNumber>::type()) {}

  Result<TuplePtr> next() override {
    A3D_TRY(insert());
    A3D_ASSIGN(const TuplePtr next, inserted_->next());
    return next == nullptr ? next : tuple_with_id(*next, next->id);
  }
  bool has_batches() const override { return true; }
  Result<const Batch*> next_batch(std::size_t most) override {
    A3D_TRY(insert());
    A3D_ASSIGN(const Batch* const batch, batches_->next(most));
    if (batch == nullptr) return nullptr;
    ids_.restart(batch->size);
    batch->rows.for_each([&](std::size_t row) { ids_.set(row, id_value(batch->ids[row])); });
    batch_ = *batch;
    batch_.ids = nullptr;
    batch_.columns.push_back(&ids_);
    return &batch_;
  }

 private:
  Status insert() {
    if (inserted_ != nullptr) return {};
    A3D_ASSIGN(inserted_, relation_->insert_all(*tuples_, context_));
    batches_.emplace(*inserted_);
    return {};
  }

  TupleStreamPtr tuples_;
  RelationPtr relation_;
  const Context& context_;
  TupleStreamPtr inserted_;
  std::optional<BatchReader> batches_;  // of those that were inserted
  algebra3d::ValueColumn ids_;
  Batch batch_;
};

/// The conversions that make tuples of a stream those of a relation whose attributes have the same names.
Result<std::vector<Conversion>> tuple_conversions(const MappingCheck& check, const TypeExpr& wanted,
                                                  const TypeExpr& given) {
  const auto& to = wanted.attributes();
  const auto& from = given.attributes();
  std::vector<Conversion> conversions;
  for (std::size_t i = 0; i < std::min(to.size(), from.size()) && to[i].name == from[i].name; ++i)
    if (const auto conversion = conversion_to(to[i].type, from[i].type)) conversions.push_back(*conversion);
  if (conversions.size() == to.size() && to.size() == from.size()) return conversions;
  return check.expected("a stream of " + wanted.text(), given);
}

TupleStreamPtr converted_tuples(const TupleStreamPtr& tuples, const std::vector<Conversion>& conversions) {
  if (std::ranges::all_of(conversions, [](Conversion each) { return each == nullptr; })) return tuples;
  return make_stream([tuples, conversions]() -> Result<TuplePtr> {
    A3D_ASSIGN(const TuplePtr tuple, tuples->next());
    if (tuple == nullptr) return tuple;
    Tuple result;
    for (std::size_t i = 0; i < conversions.size(); ++i)
      result.attributes.push_back(converted(tuple->attributes[i], conversions[i]));
    return TuplePtr(std::make_shared<const Tuple>(std::move(result)));
  });
}

Result<BoundOperator> map_insert(std::span<const ArgumentType> arguments) {
  const MappingCheck check("insert", arguments);
  A3D_ASSIGN(const TypeExpr given_tuple, check.stream(0));
  A3D_ASSIGN(const TypeExpr tuple, check.relation(1));
  A3D_ASSIGN(const auto conversions, tuple_conversions(check, tuple, given_tuple));
  A3D_ASSIGN(const TypeExpr result, check.with_id(tuple));
  return BoundOperator{TypeExpr::stream(result),
                       [conversions](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         return Datum{TupleStreamPtr(std::make_shared<InsertedTuples>(
                             converted_tuples(given[0].tuples(), conversions), given[1].relation(), context))};
                       }};
}

/// Tuples by their quick hash, as many as the work memory takes: the table of StreamBlocks.
class WantedTuples {
 public:
  explicit WantedTuples(const Context& context) : account_(context.memory) {}

  Result<bool> add(const TuplePtr& tuple) {
    if (!account_.take(heap_bytes(*tuple) + kBytesToFind) && !tuples_.empty()) return false;
    tuples_.emplace(quick_hash(*tuple), tuple);
    return true;
  }
  Result<bool> contains(const Tuple& tuple) const {
    const auto [first, last] = tuples_.equal_range(quick_hash(tuple));
    for (auto candidate = first; candidate != last; ++candidate) {
      A3D_ASSIGN(const bool equal, are_equal(*candidate->second, tuple));
      if (equal) return true;
    }
    return false;
  }
  void clear() {
    tuples_.clear();
    account_.clear();
  }

 private:
  static constexpr std::size_t kBytesToFind = 64;
  algebra3d::MemoryAccount account_;
  std::unordered_multimap<std::size_t, TuplePtr> tuples_;
};

/// The tuples of the relation that equal one of the stream, loaded, each once. The relation is read once for each part
/// of the stream that fits into memory.
Result<TupleBuffer> equal_tuples(const TupleStreamPtr& wanted, Relation& relation, const Context& context) {
  TupleBuffer found(context);
  std::unordered_set<TupleId> known;
  StreamBlocks blocks(wanted);
  WantedTuples part(context);
  while (true) {
    A3D_ASSIGN(const bool is_last, blocks.fill(part, context));
    A3D_ASSIGN(const TupleStreamPtr all, relation.scan());
    A3D_TRY(for_each_tuple(*all, context, [&](const TuplePtr& tuple) -> Status {
      A3D_ASSIGN(const bool is_wanted, part.contains(*tuple));
      if (!is_wanted || !known.insert(tuple->id).second) return {};
      A3D_ASSIGN(TuplePtr loaded, loaded_tuple(*tuple));
      return found.add(std::move(loaded));
    }));
    if (is_last) return found;
    part.clear();
  }
}

/// Erases the tuples, and passes them on with their ids.
Result<TupleStreamPtr> erase_all(const TupleBuffer& doomed, Relation& relation, const Context& context) {
  std::vector<TupleId> ids;
  A3D_TRY(for_each_tuple(*doomed.scan(), context, [&](const TuplePtr& tuple) {
    ids.push_back(tuple->id);
    return Status();
  }));
  A3D_TRY(relation.erase_all(ids, context));
  return tuples_with_ids(doomed);
}

/// Erases tuples of a relation that changes in columns, and passes them on with their ids.
Result<TupleStreamPtr> erase_in_columns(Operand operand, const Context& context) {
  const RelationPtr relation = operand.relation;
  BatchBuffer doomed(context);
  std::vector<TupleId> ids;
  {
    OwnTuples own(std::move(operand));
    A3D_TRY(for_each_batch(own, context, [&](const Batch& batch) { return doomed.add(batch); }));
    ids = own.take_ids();
  }
  A3D_TRY(relation->erase_all(ids, context));
  std::vector<std::size_t> attributes(relation->tuple_type().attributes().size());
  std::iota(attributes.begin(), attributes.end(), std::size_t{0});
  return attributes_with_ids(doomed.scan(), std::move(attributes), std::move(ids));
}

Result<BoundOperator> map_deletesearch(std::span<const ArgumentType> arguments) {
  A3D_ASSIGN(const TypeExpr result, changed_type(MappingCheck("deletesearch", arguments)));
  return BoundOperator{TypeExpr::stream(result), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         return Datum{made_when_asked([tuples = given[0].tuples(), relation = given[1].relation(),
                                                       &context]() -> Result<TupleStreamPtr> {
                           A3D_ASSIGN(const TupleBuffer doomed, equal_tuples(tuples, *relation, context));
                           return erase_all(doomed, *relation, context);
                         })};
                       }};
}

/// `are_own`: the plan says that the tuples are of the relation.
BoundOperator delete_operator(const TypeExpr& result, bool are_own) {
  ChangesTuples role;
  if (!are_own) role.of_own = [result] { return delete_operator(result, true); };
  return {TypeExpr::stream(result),
          [are_own](std::vector<Datum> given, Context& context) -> Result<Datum> {
            Operand operand{given[0].tuples(), given[1].relation(), "deletedirect", are_own};
            return Datum{made_when_asked([operand = std::move(operand), &context]() mutable -> Result<TupleStreamPtr> {
              if (operand.relation->changes_in_columns()) return erase_in_columns(std::move(operand), context);
              A3D_ASSIGN(const TupleBuffer doomed, own_tuples(operand, context));
              return erase_all(doomed, *operand.relation, context);
            })};
          },
          std::move(role)};
}

Result<BoundOperator> map_deletedirect(std::span<const ArgumentType> arguments) {
  A3D_ASSIGN(const TypeExpr result, changed_type(MappingCheck("deletedirect", arguments)));
  return delete_operator(result, false);
}

Result<BoundOperator> map_deletebyid(std::span<const ArgumentType> arguments) {
  const MappingCheck check("deletebyid", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.relation(0));
  A3D_TRY(check.id_argument(1));
  A3D_ASSIGN(const TypeExpr result, check.with_id(tuple));
  return BoundOperator{TypeExpr::stream(result), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         return Datum{made_when_asked([relation = given[0].relation(), id = given[1].value(),
                                                       &context]() -> Result<TupleStreamPtr> {
                           A3D_ASSIGN(const TupleBuffer doomed, tuple_by_id(id, *relation));
                           return erase_all(doomed, *relation, context);
                         })};
                       }};
}

}  // namespace

void register_changes(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "inserttuple",
      .syntax = "_ inserttuple[_ ...]",
      .doc = "Inserts one tuple into a stored relation and returns it with its id as TID; takes effect when consumed "
             "or counted.",
      .detail = "One value per attribute, in order. Indexes on the relation follow.",
      .is_pure = false,
      .changes_relations = true,
      .stream = stream_operator(map_inserttuple),
      .signatures = {"(rel(tuple) DATA ...) -> stream(tuple)"},
      .handles_undefined = true,
      .gives_one_tuple = true,
      .query_examples = {{"Boxes inserttuple[4, rectangle3(0, 1, 0, 1, 0, 1)] consume",
                          "((4 (0.0 1.0 0.0 1.0 0.0 1.0) 4))"},
                         {"Boxes inserttuple[5, [const rect3 value undefined]] count", "1"}},
      .query_errors = {{"query [const rel(tuple([A: int])) value ()] inserttuple[1, 2] count",
                        "inserttuple: expected 1 values, one per attribute, got 2"},
                       {"query [const rel(tuple([A: int])) value ()] inserttuple[TRUE] count",
                        "inserttuple: expected int for the attribute 'A', got bool"},
                       {"query [const rel(tuple([A: int])) value ()] inserttuple[1] count",
                        "only a relation that is stored as an object can be changed"}},
  });
  group.add({
      .name = "insert",
      .syntax = "_ _ insert",
      .doc = "Inserts all tuples of a stream into a stored relation and returns them with their new ids as TID; "
             "takes effect when consumed or counted.",
      .detail = "The stream is read to its end first. Indexes on the relation follow. The attributes must have the "
                "names and order of the relation; ints are converted to reals, and strings and texts to each other.",
      .is_pure = false,
      .changes_relations = true,
      .stream = stream_operator(map_insert),
      .signatures = {"(stream(tuple) rel(tuple)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"Boxes feed head[2] Boxes insert project[No, TID] consume", "((1 4) (2 5))"},
                         {"Boxes feed filter[not(isdefined(.B))] Boxes insert count", "1"}},
      .query_errors = {{"query intstream(1, 2) transformstream [const rel(tuple([A: int])) value ()] insert count",
                        "insert: expected a stream of (tuple ((A int))), got (tuple ((Elem int)))"},
                       {"query intstream(1, 2) transformstream [const rel(tuple([Elem: int])) value ()] insert count",
                        "only a relation that is stored as an object can be changed"}},
  });
  group.add({
      .name = "deletesearch",
      .syntax = "_ _ deletesearch",
      .doc = "Deletes every tuple of a stored relation that equals one of the stream, and returns the deleted tuples "
             "with their ids.",
      .detail = "The stream is read to its end first. Indexes on the relation follow. Undefined equals undefined here.",
      .is_pure = false,
      .changes_relations = true,
      .stream = stream_operator(map_deletesearch),
      .signatures = {"(stream(tuple) rel(tuple)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"Boxes feed filter[.No = 1] Boxes deletesearch project[No, TID] consume", "((1 1))"},
                         {"Boxes feed filter[not(isdefined(.B))] Boxes deletesearch count", "1"}},
      .query_errors =
          {{"query intstream(1, 2) transformstream [const rel(tuple([A: int])) value ()] deletesearch count",
            "deletesearch: expected a stream of (tuple ((A int))), got (tuple ((Elem int)))"}},
  });
  group.add({
      .name = "deletedirect",
      .syntax = "_ _ deletedirect",
      .doc = "Deletes the tuples of a stream from their stored relation, and returns them with their ids.",
      .detail =
          "The stream is read to its end first. Its tuples come straight from the relation: filters, sortby and the "
          "like may come between. Indexes on the relation follow.",
      .is_pure = false,
      .changes_relations = true,
      .stream = stream_operator(map_deletedirect),
      .signatures = {"(stream(tuple) rel(tuple)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"Boxes feed filter[.No > 1] Boxes deletedirect project[No, TID] consume", "((2 2) (3 3))"},
                         {"Boxes feed filter[not(isdefined(.B))] Boxes deletedirect count", "1"}},
      .query_errors = {{"query Boxes feed project[B, No] project[No, B] Boxes deletedirect count",
                        "deletedirect: a tuple does not come straight from a stored relation"},
                       {"query Boxes feed project[No] Boxes deletedirect count",
                        "deletedirect: expected a stream of (tuple ((No int) (B rect3))), got (tuple ((No int)))"}},
  });
  group.add({
      .name = "deletebyid",
      .syntax = "_ deletebyid[_]",
      .doc = "Deletes the tuple with this id from a stored relation, and returns it with its id.",
      .detail = "Nothing if there is no such tuple. An int is accepted as an id. Indexes on the relation follow.",
      .is_pure = false,
      .changes_relations = true,
      .stream = stream_operator(map_deletebyid),
      .signatures = {"(rel(tuple) tid) -> stream(tuple)", "(rel(tuple) int) -> stream(tuple)"},
      .handles_undefined = true,
      .gives_one_tuple = true,
      .query_examples = {{"Boxes deletebyid[[const tid value 2]] project[No, TID] consume", "((2 2))"},
                         {"Boxes deletebyid[77] count", "0"},
                         {"Boxes deletebyid[[const tid value undefined]] count", "0"}},
      .query_errors = {{"query Boxes deletebyid[1.5] count", "deletebyid: expected tid or int, got real"},
                       {"query Boxes feed deletebyid[1] count", "deletebyid: expected a relation, got (stream (tuple"}},
  });
}

}  // namespace queries
