// The part of the checker that finds what a name, an attribute or an implicit parameter means.
#include <algorithm>

#include <fmt/ranges.h>

#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"
#include "queries/language/checker.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Operator;
using algebra3d::SyntaxPattern;

namespace {

bool has_attribute(const TypeExpr& type, const std::string& name) {
  return type.is_tuple() &&
         std::ranges::find(type.attributes(), name, &TypeExpr::Attribute::name) != type.attributes().end();
}

/// Joins take such operators by their names.
bool names_a_relation(const Operator& op) {
  using algebra3d::BoxCondition;
  return op.boxes != BoxCondition::none && op.boxes != BoxCondition::are_near;
}

}  // namespace

Result<TypedPtr> Checker::check(const NameUse& use, const SourcePlace& place) {
  A3D_ASSIGN(TypedPtr found, find(use.name, place));
  if (found == nullptr) return unknown_name(use.name, place);
  return found;
}

// A parameter or else an object; null if there is neither.
Result<TypedPtr> Checker::find(const std::string& name, const SourcePlace& place) {
  for (std::size_t level = 0; level < scopes_.size(); ++level) {
    const Scope& scope = scopes_[scopes_.size() - 1 - level];
    const auto found = std::ranges::find(scope.parameters, name, &Parameter::name);
    if (found != scope.parameters.end())
      return make_parameter(found->type, level, static_cast<std::size_t>(found - scope.parameters.begin()), place);
  }
  A3D_ASSIGN(const auto type, objects_.type_of(name));
  return type ? make_object(*type, name, objects_, place) : TypedPtr();
}

Result<TypedPtr> Checker::implicit_parameter(int number, const SourcePlace& place, std::string_view shown) {
  for (std::size_t level = 0; level < scopes_.size(); ++level) {
    const Scope& scope = scopes_[scopes_.size() - 1 - level];
    if (!scope.is_implicit) continue;
    if (static_cast<std::size_t>(number) > scope.parameters.size())
      return Error(ErrorCode::type_error, "'{}': the function here has {} parameter{}", shown, scope.parameters.size(),
                   scope.parameters.size() == 1 ? "" : "s")
          .at(place);
    const auto index = static_cast<std::size_t>(number - 1);
    return make_parameter(scope.parameters[index].type, level, index, place);
  }
  return Error(ErrorCode::type_error,
               "'{}' needs an operator around it that gives it a meaning, such as filter or extend", shown)
      .at(place);
}

Result<TypedPtr> Checker::check(const AttributeUse& use, const SourcePlace& place) {
  const std::string shown = (use.parameter == 2 ? ".." : ".") + use.name;
  A3D_ASSIGN(TypedPtr tuple, implicit_parameter(use.parameter, place, shown));
  if (!tuple->type().is_tuple())
    return Error(ErrorCode::type_error, "'{}': expected a tuple, got {}", shown, tuple->type().text()).at(place);
  auto index = attribute_index(tuple->type(), use.name);
  if (!index) {
    const int other = use.parameter == 1 ? 2 : 1;
    const Scope& scope = *implicit_scope();
    if (scope.parameters.size() >= 2 && use.parameter <= 2 && has_attribute(scope.parameters[other - 1].type, use.name))
      return Error(ErrorCode::unknown_name, "unknown attribute '{}', did you mean '{}{}', of the {} stream?", shown,
                   other == 2 ? ".." : ".", use.name, other == 2 ? "second" : "first")
          .at(place);
    return std::move(index).error().at(place);
  }
  TypeExpr type = tuple->type().attributes()[*index].type;
  return make_attribute(std::move(type), std::move(tuple), *index, place);
}

Result<TypedPtr> Checker::check(const ParameterUse& use, const SourcePlace& place) {
  return implicit_parameter(use.parameter, place, use.parameter == 1 ? "." : "..");
}

Error Checker::unknown_name(const std::string& name, const SourcePlace& place) {
  const std::vector<std::string> attributes = attributes_in_reach(name);
  const Operator* op = registry_.find_operator(name);
  std::string message = "unknown name '" + name + "'";
  if (!attributes.empty())
    message += fmt::format(", did you mean the attribute '{}'?", fmt::join(attributes, "' or '"));
  else if (op != nullptr)
    message = fmt::format("there is no object '{}'; the operator of that name is written {}{}", name, op->written(),
                          names_a_relation(*op) ? fmt::format(", and for a join \"{}\"", name) : "");
  else if (const std::string meant = name_meant(name); !meant.empty())
    message += ", did you mean '" + meant + "'?";
  else if (!objects_.is_open())
    return Error(ErrorCode::no_database, "{}: no database is open", message).at(place);
  return Error(ErrorCode::unknown_name, message).at(place);
}

const Checker::Scope* Checker::implicit_scope() const {
  const auto found =
      std::find_if(scopes_.rbegin(), scopes_.rend(), [](const Scope& scope) { return scope.is_implicit; });
  return found == scopes_.rend() ? nullptr : &*found;
}

// How attributes of that name are written here: `.Name`, `..Name`, attr(t, Name).
std::vector<std::string> Checker::attributes_in_reach(const std::string& name) const {
  std::vector<std::string> written;
  const Scope* implicit = implicit_scope();
  for (std::size_t i = 0; implicit != nullptr && i < implicit->parameters.size(); ++i)
    if (has_attribute(implicit->parameters[i].type, name)) written.push_back((i == 0 ? "." : "..") + name);
  if (!written.empty() || scopes_.empty()) return written;
  for (const Parameter& parameter : scopes_.back().parameters)
    if (has_attribute(parameter.type, name)) written.push_back("attr(" + parameter.name + ", " + name + ")");
  return written;
}

// The nearest of the objects, else of the attributes, else of the operators that begin an operand.
std::string Checker::name_meant(const std::string& name) {
  if (algebra3d::is_equal_but_for_case(name, "TRUE")) return "TRUE";
  if (algebra3d::is_equal_but_for_case(name, "FALSE")) return "FALSE";
  std::string nearest = algebra3d::nearest_name(name, objects_.names());
  if (!nearest.empty()) return nearest;
  std::vector<std::string> attributes;
  if (const Scope* implicit = implicit_scope(); implicit != nullptr && !implicit->parameters.empty())
    if (const TypeExpr& type = implicit->parameters.front().type; type.is_tuple())
      for (const TypeExpr::Attribute& attribute : type.attributes()) attributes.push_back(attribute.name);
  nearest = algebra3d::nearest_name(name, attributes);
  if (!nearest.empty()) return "." + nearest;
  nearest = registry_.suggestion(name);
  const Operator* op = registry_.find_operator(nearest);
  return op != nullptr && registry_.syntax(*op).shape == SyntaxPattern::Shape::prefix ? nearest : "";
}

Result<std::size_t> attribute_index(const TypeExpr& tuple, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& attribute : tuple.attributes()) names.push_back(attribute.name);
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string suggestion = algebra3d::nearest_name(name, names);
  return Error{ErrorCode::unknown_name, "unknown attribute '{}'{} attributes are {}", name,
               suggestion.empty() ? "; the" : ", did you mean '" + suggestion + "'? The",
               algebra3d::enumerate(names, 20)};
}

}  // namespace queries
