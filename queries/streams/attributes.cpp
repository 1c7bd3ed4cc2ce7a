// attr, project, extend, projectextend, rename: what a tuple consists of.
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

TypeExpr projected(const TypeExpr& tuple, const std::vector<std::size_t>& indices) {
  std::vector<TypeExpr::Attribute> attributes;
  attributes.reserve(indices.size());
  for (const std::size_t index : indices) attributes.push_back(tuple.attributes()[index]);
  return TypeExpr::tuple(std::move(attributes));
}

Result<std::vector<std::size_t>> distinct_attributes(const MappingCheck& check, std::size_t position,
                                                     const TypeExpr& tuple) {
  ASSIGN_OR_RETURN(auto indices, check.attributes(position, tuple));
  for (std::size_t i = 0; i < indices.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (indices[i] == indices[j]) return check.error("the attribute '" + check[position].names[i] + "' stands twice");
  return indices;
}

// The stream of the tuples that `change` makes of those of the operand.
template <typename Change>
Datum changed(const TupleStreamPtr& tuples, Change change) {
  return Datum{make_stream([tuples, change = std::move(change)]() mutable -> Result<TuplePtr> {
    ASSIGN_OR_RETURN(const TuplePtr tuple, tuples->next());
    if (tuple == nullptr) return TuplePtr();
    Tuple result;
    RETURN_IF_ERROR(change(tuple, result.attributes));
    return TuplePtr(std::make_shared<const Tuple>(std::move(result)));
  })};
}

Result<Plan> map_attr(std::span<const ArgumentType> arguments) {
  const MappingCheck check("attr", arguments);
  if (!check[0].type.is_tuple()) return check.expected("a tuple", check[0].type);
  ASSIGN_OR_RETURN(const std::size_t index, check.attribute(1, check[0].type));
  return Plan{check[0].type.attributes()[index].type, [index](std::vector<Datum> given, Context&) -> Result<Datum> {
                return Datum{given[0].tuple()->attributes[index]};
              }};
}

Result<Plan> map_project(std::span<const ArgumentType> arguments) {
  const MappingCheck check("project", arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  ASSIGN_OR_RETURN(const auto indices, distinct_attributes(check, 1, tuple));
  if (indices.empty()) return check.error("expected at least one attribute");
  return Plan{TypeExpr::stream(projected(tuple, indices)),
              [indices](std::vector<Datum> given, Context&) -> Result<Datum> {
                return changed(given[0].tuples(), [indices](const TuplePtr& from, std::vector<Value>& to) -> Status {
                  for (const std::size_t index : indices) to.push_back(from->attributes[index]);
                  return {};
                });
              }};
}

Result<Plan> map_extend(std::span<const ArgumentType> arguments) {
  const MappingCheck check("extend", arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  ASSIGN_OR_RETURN(const TypeExpr result, check.extended(tuple, 1));
  return Plan{TypeExpr::stream(result), [](std::vector<Datum> given, Context&) -> Result<Datum> {
                return changed(given[0].tuples(),
                               [functions = given[1].list()](const TuplePtr& from, std::vector<Value>& to) -> Status {
                                 to = from->attributes;
                                 return append_results(functions, Datum{from}, to);
                               });
              }};
}

Result<Plan> map_projectextend(std::span<const ArgumentType> arguments) {
  const MappingCheck check("projectextend", arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  ASSIGN_OR_RETURN(const auto indices, distinct_attributes(check, 1, tuple));
  ASSIGN_OR_RETURN(const TypeExpr result, check.extended(projected(tuple, indices), 2));
  return Plan{TypeExpr::stream(result), [indices](std::vector<Datum> given, Context&) -> Result<Datum> {
                return changed(
                    given[0].tuples(),
                    [indices, functions = given[2].list()](const TuplePtr& from, std::vector<Value>& to) -> Status {
                      for (const std::size_t index : indices) to.push_back(from->attributes[index]);
                      return append_results(functions, Datum{from}, to);
                    });
              }};
}

// Only the type changes.
Result<Plan> map_rename(std::span<const ArgumentType> arguments) {
  const MappingCheck check("rename", arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  std::vector<TypeExpr::Attribute> attributes = tuple.attributes();
  for (auto& attribute : attributes) attribute.name += "_" + check[1].names[0];
  return Plan{TypeExpr::stream(TypeExpr::tuple(std::move(attributes))),
              [](std::vector<Datum> given, Context&) -> Result<Datum> { return given[0]; }};
}

}  // namespace

void register_attributes(algebra3d::Registry& registry) {
  registry.add({
      .name = "attr",
      .syntax = "attr(_, attribute)",
      .doc = "The value of an attribute of a tuple; `.Name` is short for `attr(., Name)`.",
      .stream = stream_operator(map_attr),
      .signatures = {"(tuple NAME) -> DATA"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 3) transformstream filter[fun(t: TUPLE) attr(t, Elem) = 2] consume", "((2))"},
                   {"[const int value undefined] feed transformstream extend[X: attr(., Elem)] consume",
                    "((undefined undefined))"}},
      .errors = {{"query attr(5, X)", "attr: expected a tuple, got int"}},
  });
  registry.add({
      .name = "project",
      .syntax = "_ project[attributes]",
      .doc = "The tuples with the named attributes only, in the order given.",
      .stream = stream_operator(map_project),
      .signatures = {"(stream(tuple) NAMES) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 2) transformstream extend[B: .Elem * 2] project[B] consume", "((2) (4))"},
                   {"[const int value undefined] feed transformstream project[Elem] consume", "((undefined))"}},
      .errors = {{"query intstream(1, 2) transformstream project[Elm] count",
                  "project: unknown attribute 'Elm', did you mean 'Elem'?"}},
  });
  registry.add({
      .name = "extend",
      .syntax = "_ extend[functions(TUPLE)]",
      .doc = "The tuples with new attributes appended; all functions see the input tuple only.",
      .stream = stream_operator(map_extend),
      .signatures = {"(stream(tuple) ((NAME (map tuple DATA)) ...)) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 2) transformstream extend[B: .Elem * 2, C: TRUE] consume", "((1 2 TRUE) (2 4 TRUE))"},
                   {"intstream(1, 1) transformstream extend[B: [const int value undefined]] consume",
                    "((1 undefined))"}},
      .errors = {{"query intstream(1, 2) transformstream extend[Elem: 1] count",
                  "extend: the attribute 'Elem' would stand twice"}},
  });
  registry.add({
      .name = "projectextend",
      .syntax = "_ projectextend[attributes; functions(TUPLE)]",
      .doc =
          "The tuples with the named attributes, and new ones appended; a new name may be that of a dropped attribute.",
      .stream = stream_operator(map_projectextend),
      .signatures = {"(stream(tuple) NAMES ((NAME (map tuple DATA)) ...)) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 2) transformstream projectextend[; Elem: .Elem + 1] consume", "((2) (3))"},
                   {"intstream(1, 1) transformstream projectextend[Elem; B: [const real value undefined]] consume",
                    "((1 undefined))"}},
      .errors = {{"query intstream(1, 2) transformstream projectextend[Elem; Elem: 1] count",
                  "projectextend: the attribute 'Elem' would stand twice"}},
  });
  registry.add({
      .name = "rename",
      .syntax = "_ rename[name]",
      .doc = "The same tuples; each attribute A is named A_x. `S {x}` is short for `S rename[x]`.",
      .stream = stream_operator(map_rename),
      .signatures = {"(stream(tuple) NAME) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 2) transformstream rename[x] filter[.Elem_x = 2] consume", "((2))"},
                   {"[const int value undefined] feed transformstream {a} consume", "((undefined))"}},
      .errors = {{"query 5 rename[x]", "rename: expected a stream of tuples, got int"}},
  });
}

}  // namespace queries
