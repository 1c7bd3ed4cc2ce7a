#include "queries/streams/mapping.h"

#include <algorithm>

#include "algebra3d/operators/registry/conversion.h"
#include "algebra3d/values/types/nested_relation.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/tuple_number.h"
#include "base/propagate.h"
#include "queries/streams/detail/any_stream.h"
#include "queries/streams/relation.h"

namespace queries {

bool is_value_type(const TypeExpr& type) {
  if (type.is_nested_relation()) return true;
  return type.arguments().empty() && !type.is_tuple() && !type.is("list");
}

Value undefined_of(const TypeExpr& type) {
  return Value(*algebra3d::value_type(type));
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
  if (type.is_stream())
    return expected("a stream of tuples (write `transformstream` after the stream of values)", type);
  return expected("a stream of tuples", type);
}

Result<TypeExpr> MappingCheck::any_stream(std::size_t position) const {
  const TypeExpr& type = arguments_[position].type;
  if (type.is_stream()) return type.element();
  if (type.is_relation()) return expected("a stream of tuples (write `feed` after the relation)", type);
  return expected("a stream", type);
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

Status MappingCheck::takes(const TypeExpr& function, const std::vector<TypeExpr>& parameters) const {
  const std::vector<TypeExpr> given = function.function_parameters();
  if (given == parameters) return {};
  return error("expected a function of " + algebra3d::argument_list_text(parameters) + ", got one of " +
               algebra3d::argument_list_text(given));
}

Status MappingCheck::function(std::size_t position, const std::vector<TypeExpr>& parameters,
                              std::string_view result) const {
  const TypeExpr& type = arguments_[position].type;
  A3D_TRY(takes(type, parameters));
  if (type.function_result().is(result)) return {};
  return expected("a function that gives " + std::string(result), type.function_result());
}

Status MappingCheck::type(std::size_t position, std::string_view wanted) const {
  if (arguments_[position].type.is(wanted)) return {};
  return expected(wanted, arguments_[position].type);
}

Result<std::size_t> MappingCheck::attribute(std::size_t position, const TypeExpr& tuple, std::size_t which) const {
  return attribute_named(arguments_[position].names[which], tuple);
}

Result<std::size_t> MappingCheck::attribute_named(const std::string& name, const TypeExpr& tuple) const {
  std::vector<std::string> names;
  for (const auto& attribute : tuple.attributes()) names.push_back(attribute.name);
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string suggestion = algebra3d::nearest_name(name, names);
  return Error{ErrorCode::unknown_name,
               "{}: unknown attribute '{}'{} attributes are {}",
               op_,
               name,
               suggestion.empty() ? "; the" : ", did you mean '" + suggestion + "'? The",
               algebra3d::enumerate(names, 20)};
}

Result<std::vector<std::size_t>> MappingCheck::attributes(std::size_t position, const TypeExpr& tuple) const {
  std::vector<std::size_t> indices;
  for (std::size_t which = 0; which < arguments_[position].names.size(); ++which) {
    A3D_ASSIGN(const std::size_t index, attribute(position, tuple, which));
    indices.push_back(index);
  }
  return indices;
}

Result<std::vector<std::size_t>> MappingCheck::distinct_attributes(std::size_t position, const TypeExpr& tuple) const {
  if (arguments_[position].names.empty()) return error("expected at least one attribute");
  return distinct_or_no_attributes(position, tuple);
}

Result<std::vector<std::size_t>> MappingCheck::distinct_or_no_attributes(std::size_t position,
                                                                         const TypeExpr& tuple) const {
  A3D_ASSIGN(auto indices, attributes(position, tuple));
  for (std::size_t i = 0; i < indices.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (indices[i] == indices[j])
        return error("duplicate attribute name '" + arguments_[position].names[i] + "'; name each attribute once");
  return indices;
}

Result<std::size_t> MappingCheck::id_attribute(const TypeExpr& tuple) const {
  const auto& attributes = tuple.attributes();
  const auto is_id = [](const TypeExpr::Attribute& attribute) { return attribute.type.is("tid"); };
  if (std::ranges::count_if(attributes, is_id) != 1)
    return expected("tuples with one attribute of type tid (see addid and tupleid)", tuple);
  return static_cast<std::size_t>(std::ranges::find_if(attributes, is_id) - attributes.begin());
}

Status MappingCheck::id_argument(std::size_t position) const {
  const TypeExpr& given = arguments_[position].type;
  if (given.is("tid") || given.is("int")) return {};
  return expected("tid or int", given);
}

Result<Conversion> MappingCheck::conversion(std::size_t position, const TypeExpr& wanted) const {
  const TypeExpr& given = arguments_[position].type;
  if (const auto found = conversion_to(wanted, given)) return *found;
  return expected(wanted.text(), given);
}

Status MappingCheck::characters(std::size_t position) const {
  A3D_TRY(conversion(position, TypeExpr("text")));
  return {};
}

Result<TypeExpr> MappingCheck::concatenated(const TypeExpr& left, const TypeExpr& right) const {
  std::vector<TypeExpr::Attribute> all = left.attributes();
  for (const auto& attribute : right.attributes()) {
    if (std::ranges::find(all, attribute.name, &TypeExpr::Attribute::name) != all.end())
      return error("duplicate attribute name '" + attribute.name + "'; rename one side, as in `feed {x}`");
    all.push_back(attribute);
  }
  return TypeExpr::tuple(std::move(all));
}

Result<TypeExpr> MappingCheck::with_id(const TypeExpr& tuple) const {
  return concatenated(tuple, TypeExpr::tuple({{"TID", TypeExpr("tid")}}));
}

Result<TypeExpr> MappingCheck::extended(const TypeExpr& tuple, std::size_t position, const TypeExpr& parameter) const {
  const ArgumentType& argument = arguments_[position];
  std::vector<TypeExpr::Attribute> made;
  for (std::size_t i = 0; i < argument.names.size(); ++i) {
    A3D_TRY(takes(argument.types[i], {parameter}));
    const TypeExpr& result = argument.types[i].function_result();
    const std::string_view hint =
        result.is_tuple_stream() ? " (write `aconsume` after the stream of tuples for a nested relation)" : "";
    if (!is_value_type(result))
      return expected(fmt::format("a value for the attribute '{}'{}", argument.names[i], hint), result);
    if (std::ranges::find(made, argument.names[i], &TypeExpr::Attribute::name) != made.end())
      return error("duplicate attribute name '" + argument.names[i] + "'; choose another name");
    made.push_back({argument.names[i], result});
  }
  // No relation is without attributes: it could neither be written down nor be restored.
  if (made.empty() && tuple.attributes().empty()) return error("no attribute would be left");
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

std::optional<Conversion> conversion_to(const TypeExpr& wanted, const TypeExpr& given) {
  if (given == wanted) return nullptr;
  if (!wanted.arguments().empty() || !algebra3d::conversion_cost(given, wanted.name())) return std::nullopt;
  return &undefined_of(wanted).type();
}

Value converted(const Value& value, Conversion conversion) {
  return conversion == nullptr ? value : algebra3d::converted(value, *conversion);
}

Result<Value> loaded_as(const Value& value, Conversion conversion) {
  if (conversion == nullptr) return value;
  A3D_ASSIGN(const Value loaded, value.loaded());
  return algebra3d::converted(loaded, *conversion);
}

bool are_comparable(const TypeExpr& a, const TypeExpr& b) {
  const auto are_characters = [](const TypeExpr& type) { return type.is("string") || type.is("text"); };
  return a == b || (are_characters(a) && are_characters(b));
}

Value id_value(TupleId id) {
  return Value::of(algebra3d::TupleNumber{id});
}

TupleId id_of(const Value& value) {
  if (&value.type() == &algebra3d::TypeOf<algebra3d::TupleNumber>::type())
    return value.get<algebra3d::TupleNumber>().number;
  return std::max<TupleId>(value.get<std::int64_t>(), 0);
}

TypeExpr projected(const TypeExpr& tuple, const std::vector<std::size_t>& indices) {
  std::vector<TypeExpr::Attribute> attributes;
  attributes.reserve(indices.size());
  for (const std::size_t index : indices) attributes.push_back(tuple.attributes()[index]);
  return TypeExpr::tuple(std::move(attributes));
}

Result<std::vector<Value>> loaded_values(const TuplePtr& tuple) {
  std::vector<Value> values;
  values.reserve(tuple->attributes.size());
  for (const Value& attribute : tuple->attributes) {
    A3D_ASSIGN(Value loaded, attribute.loaded());
    values.push_back(std::move(loaded));
  }
  return values;
}

Result<std::vector<Value>> loaded_values(const std::optional<Value>& value) {
  A3D_ASSIGN(Value loaded, value->loaded());
  return std::vector<Value>{std::move(loaded)};
}

bool is_true(const Value& value) {
  return value.is_defined() && value.get<bool>();
}

Status append_results(const DatumList& functions, const Datum& argument, std::vector<Value>& attributes) {
  for (const Datum& function : functions) {
    A3D_ASSIGN(Value result, function.function().call_for_value({&argument, 1}));
    attributes.push_back(std::move(result));
  }
  return {};
}

std::string text_of_read(const TypeExpr& tuple, const std::vector<bool>& read) {
  std::string names;
  std::size_t count = 0;
  for (std::size_t attribute = 0; attribute < read.size(); ++attribute) {
    if (!read[attribute]) continue;
    ++count;
    names += (names.empty() ? "" : ", ") + tuple.attributes()[attribute].name;
  }
  if (count == read.size()) return {};
  return count == 0 ? "reads no attribute" : "reads " + names;
}

}  // namespace queries
