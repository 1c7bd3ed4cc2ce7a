// attr, project, remove, rename, renameAttr: which attributes a tuple has, and their names.
#include <algorithm>

#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/changed_tuples.h"
#include "queries/streams/detail/column_streams.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"

namespace queries {
namespace {

Result<BoundOperator> map_attr(std::span<const ArgumentType> arguments) {
  const MappingCheck check("attr", arguments);
  if (!check[0].type.is_tuple()) return check.expected("a tuple", check[0].type);
  A3D_ASSIGN(const std::size_t index, check.attribute(1, check[0].type));
  return BoundOperator{check[0].type.attributes()[index].type,
                       [index](std::vector<Datum> given, Context&) -> Result<Datum> {
                         return Datum{given[0].tuple()->attributes[index]};
                       },
                       ReadsAttribute{index}};
}

AttributeSources sources_of(const std::vector<std::size_t>& indices) {
  AttributeSources sources;
  for (const std::size_t index : indices) sources.push_back({false, index});
  return sources;
}

BoundOperator projection(const TypeExpr& tuple, const std::vector<std::size_t>& indices) {
  const AttributeSources sources = sources_of(indices);
  return {TypeExpr::stream(projected(tuple, indices)),
          [sources](std::vector<Datum> given, Context&) -> Result<Datum> {
            return Datum{made_tuples(given[0].tuples(), sources, {})};
          },
          MakesTuples{sources}};
}

Result<BoundOperator> map_project(std::span<const ArgumentType> arguments) {
  const MappingCheck check("project", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const auto indices, check.distinct_attributes(1, tuple));
  return projection(tuple, indices);
}

Result<BoundOperator> map_remove(std::span<const ArgumentType> arguments) {
  const MappingCheck check("remove", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const auto removed, check.distinct_attributes(1, tuple));
  std::vector<std::size_t> kept;
  for (std::size_t index = 0; index < tuple.attributes().size(); ++index)
    if (std::ranges::find(removed, index) == removed.end()) kept.push_back(index);
  if (kept.empty()) return check.error("no attribute would be left");
  return projection(tuple, kept);
}

BoundOperator same_tuples(std::vector<TypeExpr::Attribute> attributes) {
  AttributeSources sources;
  for (std::size_t index = 0; index < attributes.size(); ++index) sources.push_back({false, index});
  return {TypeExpr::stream(TypeExpr::tuple(std::move(attributes))),
          [](std::vector<Datum> given, Context&) -> Result<Datum> { return given[0]; },
          MakesTuples{std::move(sources)}};
}

Result<BoundOperator> map_rename(std::span<const ArgumentType> arguments) {
  const MappingCheck check("rename", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  std::vector<TypeExpr::Attribute> attributes = tuple.attributes();
  for (auto& attribute : attributes) attribute.name += "_" + check[1].names[0];
  return same_tuples(std::move(attributes));
}

Result<BoundOperator> map_rename_attributes(std::span<const ArgumentType> arguments) {
  const MappingCheck check("renameAttr", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  std::vector<TypeExpr::Attribute> attributes = tuple.attributes();
  std::vector<bool> is_renamed(attributes.size());
  for (std::size_t i = 0; i < check[1].names.size(); ++i) {
    A3D_ASSIGN(const std::size_t index, check.attribute_named(check[1].modifiers[i], tuple));
    if (is_renamed[index]) return check.error("the attribute '" + check[1].modifiers[i] + "' is renamed twice");
    is_renamed[index] = true;
    attributes[index].name = check[1].names[i];
  }
  for (std::size_t i = 0; i < attributes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (attributes[i].name == attributes[j].name)
        return check.error("duplicate attribute name '" + attributes[i].name + "'; choose another name");
  return same_tuples(std::move(attributes));
}

// `R feedproject[A]` is `R feed project[A]`.
Result<BoundOperator> map_feedproject(std::span<const ArgumentType> arguments) {
  const MappingCheck check("feedproject", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.relation(0));
  A3D_ASSIGN(const auto indices, check.distinct_attributes(1, tuple));
  return BoundOperator{
      TypeExpr::stream(projected(tuple, indices)),
      [indices](std::vector<Datum> given, Context& context) -> Result<Datum> {
        A3D_ASSIGN(TupleStreamPtr tuples, given[0].relation()->scan());
        return changed_tuples(
            tuples, [indices, &context, step = 0U](const TuplePtr& from, std::vector<Value>& to) mutable -> Status {
              if (++step % 256 == 0) A3D_TRY(context.check_cancelled());
              return append_attributes(*from, indices, to);
            });
      }};
}

}  // namespace

void register_attributes(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "attr",
      .syntax = "attr(_, attribute)",
      .doc = "The value of an attribute of a tuple; `.Name` is short for `attr(., Name)`.",
      .cost = algebra3d::Cost::constant,
      .stream = stream_operator(map_attr),
      .signatures = {"(tuple NAME) -> DATA"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 3) transformstream filter[fun(t: TUPLE) attr(t, Elem) = 2] consume", "((2))"},
                         {"[const int value undefined] feed transformstream extend[X: attr(., Elem)] consume",
                          "((undefined undefined))"}},
      .query_errors = {{"query attr(5, X)", "attr: expected a tuple, got int"}},
  });
  group.add({
      .name = "project",
      .syntax = "_ project[attributes]",
      .doc = "The tuples with the named attributes only, in the order given.",
      .stream = stream_operator(map_project),
      .signatures = {"(stream(tuple) NAMES) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 2) transformstream extend[B: .Elem * 2] project[B] consume", "((2) (4))"},
                         {"[const int value undefined] feed transformstream project[Elem] consume", "((undefined))"}},
      .query_errors = {{"query intstream(1, 2) transformstream project[Elm] count",
                        "project: unknown attribute 'Elm', did you mean 'Elem'?"}},
  });
  group.add({
      .name = "feedproject",
      .syntax = "_ feedproject[attributes]",
      .doc = "The tuples of a relation with the named attributes only: `feed` and `project` in one.",
      .stream = stream_operator(map_feedproject),
      .signatures = {"(rel(tuple) NAMES) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"[const rel(tuple([A: int, B: int])) value ((1 2) (3 undefined))] feedproject[B] consume",
                          "((2) (undefined))"},
                         {"[const rel(tuple([A: int, B: int])) value ((1 2))] feedproject[B, A] consume", "((2 1))"}},
      .query_errors = {{"query [const rel(tuple([A: int])) value ((1))] feedproject[B] count",
                        "feedproject: unknown attribute 'B'"},
                       {"query 5 feedproject[B] count", "feedproject: expected a relation, got int"}},
  });
  group.add({
      .name = "remove",
      .syntax = "_ remove[attributes]",
      .doc = "The tuples without the named attributes.",
      .stream = stream_operator(map_remove),
      .signatures = {"(stream(tuple) NAMES) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 2) transformstream extend[B: .Elem * 2] remove[Elem] consume", "((2) (4))"},
                         {"[const rel(tuple([A: int, B: int])) value ((1 undefined))] feed remove[A] consume",
                          "((undefined))"}},
      .query_errors = {{"query intstream(1, 2) transformstream remove[Elem] count",
                        "remove: no attribute would be left"},
                       {"query intstream(1, 2) transformstream remove[Elm] count",
                        "remove: unknown attribute 'Elm', did you mean 'Elem'?"}},
  });
  group.add({
      .name = "rename",
      .syntax = "_ rename[name]",
      .doc = "The same tuples; each attribute A is named A_x. `S {x}` is short for `S rename[x]`.",
      .stream = stream_operator(map_rename),
      .signatures = {"(stream(tuple) NAME) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 2) transformstream rename[x] filter[.Elem_x = 2] consume", "((2))"},
                         {"[const int value undefined] feed transformstream {a} consume", "((undefined))"}},
      .query_errors = {{"query 5 rename[x]", "rename: expected a stream of tuples, got int"}},
  });
  group.add({
      .name = "renameAttr",
      .syntax = "_ renameAttr[renames]",
      .doc = "The same tuples with new names for single attributes: the new name, a colon, the old name.",
      .detail = "The old name may stand in double quotes. Names may be swapped in one go.",
      .stream = stream_operator(map_rename_attributes),
      .signatures = {"(stream(tuple) ((NAME NAME) ...)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 2) transformstream renameAttr[No: Elem] filter[.No = 2] consume", "((2))"},
                         {"[const int value undefined] feed transformstream renameAttr[A: \"Elem\"] consume",
                          "((undefined))"}},
      .query_errors = {{"query intstream(1, 2) transformstream extend[B: 1] renameAttr[B: Elem] count",
                        "renameAttr: duplicate attribute name 'B'"},
                       {"query intstream(1, 2) transformstream renameAttr[A: Elm] count",
                        "renameAttr: unknown attribute 'Elm', did you mean 'Elem'?"}},
  });
}

}  // namespace queries
