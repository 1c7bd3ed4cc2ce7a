// updatedirect, updatebyid: tuples of stored relations get new values.
#include <numeric>

#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/batch_buffer.h"
#include "queries/streams/detail/column_streams.h"
#include "queries/streams/detail/relation_changes.h"

namespace queries {
namespace {

/// The attributes that a list of functions sets, and what the results are to become.
struct Assignments {
  std::vector<std::size_t> attributes;
  std::vector<Conversion> conversions;
};

Result<Assignments> assignments(const MappingCheck& check, std::size_t position, const TypeExpr& tuple) {
  Assignments result;
  A3D_ASSIGN(result.attributes, check.distinct_attributes(position, tuple));
  for (std::size_t i = 0; i < result.attributes.size(); ++i) {
    const auto& [name, wanted] = tuple.attributes()[result.attributes[i]];
    A3D_TRY(check.takes(check[position].types[i], {tuple}));
    const TypeExpr& given = check[position].types[i].function_result();
    const auto conversion = conversion_to(wanted, given);
    if (!conversion) return check.expected(wanted.text() + " for the attribute '" + name + "'", given);
    result.conversions.push_back(*conversion);
  }
  return result;
}

/// The new attributes, the old ones with `_old` after their names, and the id.
Result<TypeExpr> updated_type(const MappingCheck& check, const TypeExpr& tuple) {
  std::vector<TypeExpr::Attribute> old = tuple.attributes();
  for (auto& attribute : old) attribute.name += "_old";
  A3D_ASSIGN(const TypeExpr both, check.concatenated(tuple, TypeExpr::tuple(std::move(old))));
  return check.with_id(both);
}

// The functions may ask for the relation, so that all of them are called before anything is written.
Result<TupleStreamPtr> update_all(const TupleBuffer& old_tuples, Relation& relation, const Assignments& assignments,
                                  const DatumList& functions, const Context& context) {
  TupleBuffer new_tuples(context);
  const auto make_new = [&](const TuplePtr& old) -> Status {
    std::vector<Value> values;
    A3D_TRY(append_results(functions, Datum{old}, values));
    Tuple made = *old;
    for (std::size_t i = 0; i < values.size(); ++i) {
      Value& assigned = made.attributes[assignments.attributes[i]];
      A3D_ASSIGN(assigned, converted(values[i], assignments.conversions[i]).loaded());
    }
    return new_tuples.add(std::make_shared<const Tuple>(std::move(made)));
  };
  A3D_TRY(for_each_tuple(*old_tuples.scan(), context, make_new));
  A3D_TRY(for_each_tuple(*new_tuples.scan(), context,
                         [&](const TuplePtr& made) { return relation.update(made->id, *made); }));
  return make_stream([made_scan = new_tuples.scan(), old_scan = old_tuples.scan()]() -> Result<TuplePtr> {
    A3D_ASSIGN(const TuplePtr made, made_scan->next());
    if (made == nullptr) return made;
    A3D_ASSIGN(const TuplePtr old, old_scan->next());
    return tuple_with_id(*concatenated(*made, *old), made->id);
  });
}

/// How `updatedirect` works.
struct UpdatePlan {
  TypeExpr tuple, result;
  Assignments assigned;
  bool are_own;  ///< the plan says that the tuples are of the relation
};

/// The results of functions, converted.
class ConvertedColumns {
 public:
  /// `first`: the place of the first result in a batch.
  ConvertedColumns(const std::vector<Conversion>& conversions, std::size_t first)
      : conversions_(conversions), first_(first) {}

  Batch converted_batch(const Batch& batch) {
    Batch result = batch;
    columns_.clear();
    columns_.reserve(conversions_.size());  // the batch refers to them
    for (std::size_t i = 0; i < conversions_.size(); ++i) {
      if (conversions_[i] == nullptr) continue;
      ValueColumn& column = columns_.emplace_back(*conversions_[i]);
      column.restart(batch.size);
      batch.rows.for_each(
          [&](std::size_t row) { column.set(row, converted(batch.columns[first_ + i]->value(row), conversions_[i])); });
      result.columns[first_ + i] = &column;
    }
    return result;
  }

 private:
  const std::vector<Conversion>& conversions_;
  std::size_t first_;
  std::vector<ValueColumn> columns_;
};

// The functions may ask for the relation, so that all of them are called before anything is written. Kept are the old
// attributes, as far as they are read, and behind them the new ones.
Result<TupleStreamPtr> update_in_columns(Operand operand, const UpdatePlan& plan, const DatumList& functions,
                                         const Context& context) {
  const RelationPtr relation = operand.relation;
  const std::size_t count = plan.tuple.attributes().size();
  BatchBuffer changes(context);
  std::vector<TupleId> ids;
  {
    const auto own = std::make_shared<OwnTuples>(std::move(operand));
    AttributeSources sources;
    for (std::size_t index = 0; index < count; ++index) sources.push_back({false, index});
    for (std::size_t i = 0; i < functions.size(); ++i) sources.push_back({true, i});
    ConvertedColumns conversion(plan.assigned.conversions, count);
    A3D_TRY(for_each_batch(*made_tuples(own, std::move(sources), functions), context,
                           [&](const Batch& batch) { return changes.add(conversion.converted_batch(batch)); }));
    ids = own->take_ids();
  }
  AttributeSources values;
  std::vector<std::size_t> shown(2 * count);
  std::iota(shown.begin(), shown.begin() + static_cast<std::ptrdiff_t>(count), std::size_t{0});
  std::iota(shown.begin() + static_cast<std::ptrdiff_t>(count), shown.end(), std::size_t{0});
  for (std::size_t i = 0; i < functions.size(); ++i) {
    values.push_back({false, count + i});
    shown[plan.assigned.attributes[i]] = count + i;
  }
  A3D_TRY(relation->update_all(ids, plan.assigned.attributes, *made_tuples(changes.scan(), values, {}), context));
  return attributes_with_ids(changes.scan(), std::move(shown), std::move(ids));
}

BoundOperator update_operator(const UpdatePlan& plan) {
  ChangesTuples role;
  if (!plan.are_own) role.of_own = [plan] { return update_operator({plan.tuple, plan.result, plan.assigned, true}); };
  return {TypeExpr::stream(plan.result),
          [plan](std::vector<Datum> given, Context& context) -> Result<Datum> {
            Operand operand{given[0].tuples(), given[1].relation(), "updatedirect", plan.are_own};
            return Datum{made_when_asked([operand = std::move(operand), functions = given[2].list(), plan,
                                          &context]() mutable -> Result<TupleStreamPtr> {
              if (operand.relation->changes_in_columns())
                return update_in_columns(std::move(operand), plan, functions, context);
              A3D_ASSIGN(const TupleBuffer old, own_tuples(operand, context));
              return update_all(old, *operand.relation, plan.assigned, functions, context);
            })};
          },
          std::move(role)};
}

Result<BoundOperator> map_updatedirect(std::span<const ArgumentType> arguments) {
  const MappingCheck check("updatedirect", arguments);
  A3D_ASSIGN(const TypeExpr given_tuple, check.stream(0));
  A3D_ASSIGN(const TypeExpr tuple, check.relation(1));
  if (!(given_tuple == tuple)) return check.expected("a stream of " + tuple.text(), given_tuple);
  A3D_ASSIGN(const Assignments assigned, assignments(check, 2, tuple));
  A3D_ASSIGN(const TypeExpr result, updated_type(check, tuple));
  return update_operator({tuple, result, assigned, false});
}

Result<BoundOperator> map_updatebyid(std::span<const ArgumentType> arguments) {
  const MappingCheck check("updatebyid", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.relation(0));
  A3D_TRY(check.id_argument(1));
  A3D_ASSIGN(const Assignments assigned, assignments(check, 2, tuple));
  A3D_ASSIGN(const TypeExpr result, updated_type(check, tuple));
  return BoundOperator{
      TypeExpr::stream(result), [assigned](std::vector<Datum> given, Context& context) -> Result<Datum> {
        return Datum{made_when_asked([relation = given[0].relation(), id = given[1].value(),
                                      functions = given[2].list(), assigned, &context]() -> Result<TupleStreamPtr> {
          A3D_ASSIGN(const TupleBuffer old, tuple_by_id(id, *relation));
          return update_all(old, *relation, assigned, functions, context);
        })};
      }};
}

}  // namespace

void register_updates(algebra3d::OperatorGroup& group) {
  const std::string output =
      "The result has the new attributes, the old ones named A_old, and TID; it takes effect when consumed or "
      "counted. All functions see the old tuple, and are called before anything is written. Indexes on the relation "
      "follow.";
  group.add({
      .name = "updatedirect",
      .syntax = "_ _ updatedirect[functions(TUPLE)]",
      .doc = "Gives the tuples of a stream new values in the stored relation that they come from.",
      .detail = "The tuples come straight from the relation: filters, sortby and the like may come between. " + output,
      .is_pure = false,
      .changes_relations = true,
      .stream = stream_operator(map_updatedirect),
      .signatures = {"(stream(tuple) rel(tuple) ((NAME (map tuple DATA)) ...)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples =
          {{"Boxes feed filter[.No < 3] Boxes updatedirect[No: .No + 10] project[No, No_old, TID] consume",
            "((11 1 1) (12 2 2))"},
           {"Boxes feed head[1] Boxes updatedirect[No: [const int value undefined]] project[No] consume",
            "((undefined))"}},
      .query_errors = {{"query Boxes feed Boxes updatedirect[No: TRUE] count",
                        "updatedirect: expected int for the attribute 'No', got bool"},
                       {"query Boxes feed Boxes updatedirect[Nr: 1] count",
                        "updatedirect: unknown attribute 'Nr', did you mean 'No'?"},
                       {"query Boxes feed project[B, No] project[No, B] Boxes updatedirect[No: 1] count",
                        "updatedirect: a tuple does not come straight from a stored relation"}},
  });
  group.add({
      .name = "updatebyid",
      .syntax = "_ updatebyid[_; functions(TUPLE)]",
      .doc = "Gives the tuple with that id new values in a stored relation.",
      .detail = "Nothing if there is no such tuple. An int is accepted as an id. " + output,
      .is_pure = false,
      .changes_relations = true,
      .stream = stream_operator(map_updatebyid),
      .signatures = {"(rel(tuple) tid ((NAME (map tuple DATA)) ...)) -> stream(tuple)",
                     "(rel(tuple) int ((NAME (map tuple DATA)) ...)) -> stream(tuple)"},
      .handles_undefined = true,
      .gives_one_tuple = true,
      .query_examples = {{"Boxes updatebyid[2; No: .No * 10] project[No, No_old, TID] consume", "((20 2 2))"},
                         {"Boxes updatebyid[[const tid value undefined]; No: 1] count", "0"}},
      .query_errors = {{"query Boxes updatebyid[TRUE; No: 1] count", "updatebyid: expected tid or int, got bool"},
                       {"query [const rel(tuple([A: int])) value ((1))] updatebyid[0; A: 2] count",
                        "only a relation that is stored as an object can be changed"}},
  });
}

}  // namespace queries
