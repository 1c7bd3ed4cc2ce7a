#include "algebra3d/values/types/type_expr.h"

#include <algorithm>

#include "base/propagate.h"

namespace algebra3d {

namespace {

bool is_name(std::string_view text) {
  const auto is_letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return !text.empty() && is_letter(text[0]) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return is_letter(c) || is_digit(c); });
}

Error no_type(std::string_view expected, const NestedList& found) {
  return {ErrorCode::invalid_value, "type: expected {}, got {}", expected, found.print_short()};
}

Result<TypeExpr::Attribute> attribute_from_nested(const NestedList& list) {
  if (!list.is_list() || list.elements().size() != 2 || !list.elements()[0].is_symbol() ||
      !is_name(list.elements()[0].as_symbol())) {
    return no_type("an attribute (Name type)", list);
  }
  A3D_ASSIGN(auto type, TypeExpr::from_nested(list.elements()[1]));
  return TypeExpr::Attribute{list.elements()[0].as_symbol(), std::move(type)};
}

Result<TypeExpr> tuple_from_nested(const NestedList& list) {
  const auto& terms = list.elements();
  if (terms.size() != 2 || !terms[1].is_list()) return no_type("(tuple ((Name type) ...))", list);
  std::vector<TypeExpr::Attribute> attributes;
  attributes.reserve(terms[1].elements().size());
  for (const auto& element : terms[1].elements()) {
    A3D_ASSIGN(auto attribute, attribute_from_nested(element));
    attributes.push_back(std::move(attribute));
  }
  return TypeExpr::tuple(std::move(attributes));
}

NestedList name_to_nested(const std::string& name) {
  if (name == "TRUE" || name == "FALSE") return NestedList(name == "TRUE");
  return NestedList::symbol(name);
}

}  // namespace

TypeExpr::TypeExpr(std::string_view name, std::vector<TypeExpr> arguments)
    : content_(std::make_shared<const Content>(Content{std::string(name), std::move(arguments), {}})) {}

TypeExpr TypeExpr::tuple(std::vector<Attribute> attributes) {
  TypeExpr result;
  result.content_ = std::make_shared<const Content>(Content{"tuple", {}, std::move(attributes)});
  return result;
}

TypeExpr TypeExpr::map(std::vector<TypeExpr> parameters, TypeExpr result) {
  parameters.push_back(std::move(result));
  return {"map", std::move(parameters)};
}

std::vector<TypeExpr> TypeExpr::function_parameters() const {
  return {arguments().begin(), arguments().end() - 1};
}

// Recursion follows the nesting of the type, which NestedList::kMaxDepth bounds for everything that users write.
// NOLINTNEXTLINE(misc-no-recursion)
NestedList TypeExpr::to_nested() const {
  if (is_tuple()) {
    NestedList::List attribute_list;
    attribute_list.reserve(attributes().size());
    for (const auto& [name, type] : attributes()) {
      attribute_list.push_back(NestedList::list(NestedList::symbol(name), type.to_nested()));
    }
    return NestedList::list(NestedList::symbol("tuple"), NestedList(std::move(attribute_list)));
  }
  if (arguments().empty()) return name_to_nested(name());
  NestedList::List terms;
  terms.reserve(arguments().size() + 1);
  terms.push_back(name_to_nested(name()));
  for (const auto& argument : arguments()) terms.push_back(argument.to_nested());
  return NestedList(std::move(terms));
}

Result<TypeExpr> TypeExpr::from_nested(const NestedList& list) {
  if (list.is_bool()) return TypeExpr(list.as_bool() ? "TRUE" : "FALSE");
  if (list.is_symbol("tuple")) return no_type("(tuple ((Name type) ...))", list);
  if (list.is_symbol() && is_name(list.as_symbol())) return TypeExpr(list.as_symbol());
  if (!list.is_list()) return no_type("a name or (constructor type ...)", list);
  const auto& terms = list.elements();
  if (terms.size() < 2 || !terms[0].is_symbol() || !is_name(terms[0].as_symbol())) {
    return no_type("a name or (constructor type ...)", list);
  }
  if (terms[0].is_symbol("tuple")) return tuple_from_nested(list);
  std::vector<TypeExpr> arguments;
  arguments.reserve(terms.size() - 1);
  for (auto term = terms.begin() + 1; term != terms.end(); ++term) {
    A3D_ASSIGN(auto argument, from_nested(*term));
    arguments.push_back(std::move(argument));
  }
  return TypeExpr(terms[0].as_symbol(), std::move(arguments));
}

bool operator==(const TypeExpr& a, const TypeExpr& b) {
  return a.content_ == b.content_ ||
         (a.name() == b.name() && a.arguments() == b.arguments() && a.attributes() == b.attributes());
}

}  // namespace algebra3d
