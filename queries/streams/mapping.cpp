#include "queries/streams/mapping.h"

#include <algorithm>

#include "algebra3d/types/all.h"
#include "queries/streams/relation.h"

namespace queries {

bool is_value_type(const TypeExpr& type) {
  return type.arguments().empty() && !type.is_tuple() && !type.is("list");
}

Value undefined_of(const TypeExpr& type) {
  const auto types = algebra3d::all_types();
  return Value(**std::ranges::find_if(types, [&](const algebra3d::Type* known) { return type.is(known->name()); }));
}

Error MappingCheck::error(std::string_view text) const {
  return {ErrorCode::type_error, "{}: {}", op_, text};
}

Error MappingCheck::expected(std::string_view what, const TypeExpr& got) const {
  return {ErrorCode::type_error, "{}: expected {}, got {}", op_, what, got.text()};
}

Result<TypeExpr> MappingCheck::stream(std::size_t position) const {
  const TypeExpr& type = arguments_[position].type;
  if (type.is_tuple_stream()) return type.element();
  if (type.is_relation()) return expected("a stream of tuples (write `feed` after the relation)", type);
  return expected("a stream of tuples", type);
}

Result<TypeExpr> MappingCheck::relation(std::size_t position) const {
  const TypeExpr& type = arguments_[position].type;
  if (type.is_relation()) return type.element();
  return expected("a relation", type);
}

Result<TypeExpr> MappingCheck::stream_or_relation(std::size_t position) const {
  const TypeExpr& type = arguments_[position].type;
  if (type.is_relation() || type.is_tuple_stream()) return type.element();
  return expected("a relation or a stream of tuples", type);
}

Status MappingCheck::function(std::size_t position, std::string_view result) const {
  const TypeExpr& type = arguments_[position].type;
  const TypeExpr& given = type.is_function() ? type.function_result() : type;
  if (result.empty() ? is_value_type(given) : given.is(result)) return {};
  return expected("a function that gives " + (result.empty() ? "a value" : std::string(result)), given);
}

Status MappingCheck::type(std::size_t position, std::string_view wanted) const {
  if (arguments_[position].type.is(wanted)) return {};
  return expected(wanted, arguments_[position].type);
}

Result<std::size_t> MappingCheck::attribute(std::size_t position, const TypeExpr& tuple, std::size_t which) const {
  const std::string& name = arguments_[position].names[which];
  std::vector<std::string> names;
  for (const auto& attribute : tuple.attributes()) names.push_back(attribute.name);
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string suggestion = algebra3d::nearest_name(name, names);
  return Error{ErrorCode::unknown_name,
               "{}: unknown attribute '{}'{}; the attributes are {}",
               op_,
               name,
               suggestion.empty() ? "" : ", did you mean '" + suggestion + "'?",
               algebra3d::enumerate(names, 20)};
}

Result<std::vector<std::size_t>> MappingCheck::attributes(std::size_t position, const TypeExpr& tuple) const {
  std::vector<std::size_t> indices;
  for (std::size_t which = 0; which < arguments_[position].names.size(); ++which) {
    ASSIGN_OR_RETURN(const std::size_t index, attribute(position, tuple, which));
    indices.push_back(index);
  }
  return indices;
}

Result<TypeExpr> MappingCheck::concatenated(const TypeExpr& left, const TypeExpr& right) const {
  std::vector<TypeExpr::Attribute> all = left.attributes();
  for (const auto& attribute : right.attributes()) {
    if (std::ranges::find(all, attribute.name, &TypeExpr::Attribute::name) != all.end())
      return error("the attribute '" + attribute.name + "' would stand twice; rename one side, as in `feed {x}`");
    all.push_back(attribute);
  }
  return TypeExpr::tuple(std::move(all));
}

Result<TypeExpr> MappingCheck::extended(const TypeExpr& tuple, std::size_t position) const {
  const ArgumentType& argument = arguments_[position];
  std::vector<TypeExpr::Attribute> made;
  for (std::size_t i = 0; i < argument.names.size(); ++i) {
    const TypeExpr& result = argument.types[i].function_result();
    if (!is_value_type(result)) return expected("a value for the attribute '" + argument.names[i] + "'", result);
    if (std::ranges::find(made, argument.names[i], &TypeExpr::Attribute::name) != made.end())
      return error("the attribute '" + argument.names[i] + "' would stand twice");
    made.push_back({argument.names[i], result});
  }
  return concatenated(tuple, TypeExpr::tuple(std::move(made)));
}

Status MappingCheck::argument_count(std::size_t least, std::size_t most) const {
  if (least <= count() && count() <= most) return {};
  return error(fmt::format("expected {} to {} arguments, got {}", least, most, count()));
}

Result<TupleStreamPtr> tuples_of(const Datum& operand) {
  if (const auto* stream = std::get_if<TupleStreamPtr>(&operand.content)) return *stream;
  return operand.relation()->scan();
}

TuplePtr concatenated(const Tuple& left, const Tuple& right) {
  Tuple joined;
  joined.attributes.reserve(left.attributes.size() + right.attributes.size());
  joined.attributes.insert(joined.attributes.end(), left.attributes.begin(), left.attributes.end());
  joined.attributes.insert(joined.attributes.end(), right.attributes.begin(), right.attributes.end());
  return std::make_shared<const Tuple>(std::move(joined));
}

Result<Value> call_on(const Function& function, const TuplePtr& tuple) {
  const Datum argument{tuple};
  ASSIGN_OR_RETURN(Datum result, function.call({&argument, 1}));
  return std::get<Value>(std::move(result.content));
}

bool is_true(const Value& value) {
  return value.is_defined() && value.get<bool>();
}

Status append_results(const DatumList& functions, const Datum& argument, std::vector<Value>& attributes) {
  for (const Datum& function : functions) {
    ASSIGN_OR_RETURN(Datum result, function.function().call({&argument, 1}));
    attributes.push_back(std::get<Value>(std::move(result.content)));
  }
  return {};
}

}  // namespace queries
