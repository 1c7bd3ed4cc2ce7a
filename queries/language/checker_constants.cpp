// The part of the checker that makes constants and resolves types.
#include "queries/language/checker.h"
#include "queries/streams/relation.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;

}  // namespace

Result<TypedPtr> Checker::constant(const TypeExpr& type, const NestedList& list, const SourcePlace& place) {
  if (type.is_relation()) {
    ASSIGN_OR_RETURN(Datum relation, relation_constant(type, list, place));
    return make_constant(type, std::move(relation), place);
  }
  const algebra3d::Type* value_type = type.arguments().empty() ? registry_.find_type(type.name()) : nullptr;
  if (value_type == nullptr)
    return Error(ErrorCode::type_error, "a constant cannot be of type {}", type.text()).at(place);
  auto value = algebra3d::value_from_nested(*value_type, list, context_);
  if (!value) return std::move(value).error().at(place);
  return make_constant(type, Datum{std::move(value).value()}, place);
}

Result<Datum> Checker::relation_constant(const TypeExpr& type, const NestedList& list, const SourcePlace& place) {
  const auto& attributes = type.element().attributes();
  if (!list.is_list())
    return Error(ErrorCode::invalid_value, "rel: expected a list of tuples, got {}", list.print_short()).at(place);
  std::vector<TuplePtr> tuples;
  for (const NestedList& row : list.elements()) {
    if (!row.is_list() || row.elements().size() != attributes.size())
      return Error(ErrorCode::invalid_value, "rel: tuple {}: expected a list of {} values, got {}", tuples.size() + 1,
                   attributes.size(), row.print_short())
          .at(place);
    Tuple tuple;
    for (std::size_t index = 0; index < attributes.size(); ++index) {
      const algebra3d::Type* attribute_type = registry_.find_type(attributes[index].type.name());
      auto value = algebra3d::value_from_nested(*attribute_type, row.elements()[index], context_);
      if (!value) {
        Error error = std::move(value).error();
        error.message =
            fmt::format("rel: tuple {}, attribute {}: {}", tuples.size() + 1, attributes[index].name, error.message);
        return std::move(error).at(place);
      }
      tuple.attributes.push_back(std::move(value).value());
    }
    tuples.push_back(std::make_shared<const Tuple>(std::move(tuple)));
  }
  return Datum{
      std::shared_ptr<Relation>(std::make_shared<MemoryRelation>(type.element(), TupleBuffer(std::move(tuples))))};
}

Result<TypeExpr> Checker::resolve(const TypeSyntax& syntax) {
  if (syntax.type_of != nullptr) {
    ASSIGN_OR_RETURN(const TypedPtr node, check(*syntax.type_of));
    return node->type();
  }
  if (!syntax.attributes.empty()) {
    std::vector<TypeExpr::Attribute> attributes;
    for (const auto& [name, attribute] : syntax.attributes) {
      for (const TypeExpr::Attribute& earlier : attributes)
        if (earlier.name == name)
          return Error(ErrorCode::type_error, "tuple: the attribute '{}' stands twice", name).at(syntax.place);
      ASSIGN_OR_RETURN(TypeExpr type, resolve(attribute));
      if (registry_.find_type(type.name()) == nullptr)
        return Error(ErrorCode::type_error, "tuple: attribute '{}': expected a type of kind DATA, got {}", name,
                     type.text())
            .at(syntax.place);
      attributes.push_back({name, std::move(type)});
    }
    return TypeExpr::tuple(std::move(attributes));
  }
  std::vector<TypeExpr> arguments;
  for (const TypeSyntax& argument : syntax.arguments) {
    ASSIGN_OR_RETURN(TypeExpr type, resolve(argument));
    arguments.push_back(std::move(type));
  }
  TypeExpr type(syntax.name, std::move(arguments));
  if (type.arguments().empty() && registry_.find_type(type.name()) == nullptr) {
    ASSIGN_OR_RETURN(const auto named, objects_.named_type(type.name()));
    if (named) return *named;
  }
  RETURN_IF_ERROR(check_type_name(type, syntax.place));
  return type;
}

Status Checker::check_type_name(const TypeExpr& type, const SourcePlace& place) {
  if (type.is_relation() || type.is_stream() || type.is_function()) return {};
  if (type.arguments().empty() && registry_.find_type(type.name()) != nullptr) return {};
  std::vector<std::string> names = {"rel", "tuple", "stream", "map"};
  for (const algebra3d::Type* known : registry_.types()) names.emplace_back(known->name());
  const std::string suggestion = algebra3d::nearest_name(type.name(), names);
  return Error(ErrorCode::unknown_name, "unknown type '{}'{}", type.text(),
               suggestion.empty() || suggestion == type.name() ? "" : ", did you mean '" + suggestion + "'?")
      .at(place);
}

}  // namespace queries
