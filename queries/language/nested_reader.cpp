#include "queries/language/nested_reader.h"

#include <algorithm>

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/types/expression_list.h"
#include "algebra3d/values/types/file_atom.h"
#include "base/number_text.h"
#include "base/propagate.h"
#include "queries/language/parser.h"
#include "queries/language/scanner.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Operator;
using algebra3d::Result;
using algebra3d::Status;
using algebra3d::SyntaxPattern;
using PlaceKind = SyntaxPattern::PlaceKind;

namespace {

bool is_symbol(const NestedList& list, std::string_view spelling) {
  return list.is_symbol() && list.as_symbol() == spelling;
}

bool is_pair(const NestedList& list) {
  return list.is_list() && list.elements().size() == 2;
}

std::string_view symbol_in(const NestedList& list) {
  return list.is_symbol() ? std::string_view(list.as_symbol()) : "";
}

// The names in lists of attributes may also be written as strings.
std::string name_in(const NestedList& list) {
  const std::string name = list.is_symbol() ? list.as_symbol() : list.is_string() ? list.as_string() : "";
  return is_identifier(name) ? name : "";
}

bool is_in_spare_parentheses(const NestedList& list) {
  return list.is_list() && list.elements().size() == 1 && list.elements().front().is_list();
}

// `((Name e) ...)`; the names are looked at later.
bool has_form_of_functions(const NestedList& list) {
  return list.is_list() && std::ranges::all_of(list.elements(), [](const NestedList& element) {
           return is_pair(element) && !element.elements()[0].is_list();
         });
}

bool is_fraction(std::string_view symbol) {
  return symbol.find('/') != std::string_view::npos && symbol.find_first_of("0123456789") <= 1;
}

}  // namespace

/// One level further down, as long as it lives.
class NestedReader::Deeper {
 public:
  explicit Deeper(NestedReader& reader) : depth_(reader.depth_) { ++depth_; }
  ~Deeper() { --depth_; }
  Deeper(const Deeper&) = delete;
  Deeper& operator=(const Deeper&) = delete;
  Status check(const SourcePlace& place) const { return depth_ <= kMaxExpressionHeight ? Status() : too_high(place); }

 private:
  int& depth_;
};

Error NestedReader::error(std::string_view expected, const NestedList& found) const {
  return Error(ErrorCode::syntax_error, "expected {}, found {}", expected, found.print_short()).at(place_);
}

Result<ExpressionPtr> NestedReader::make(ExpressionNode node) const {
  const int height = 1 + height_below(node);
  if (height <= kMaxExpressionHeight)
    return std::make_shared<const Expression>(Expression{place_, std::move(node), height});
  return too_high(place_);
}

// Each level makes a node, so a tree that is too high is refused on the way down, before much stack is used.
// NOLINTNEXTLINE(misc-no-recursion)
Result<ExpressionPtr> NestedReader::expression(const NestedList& list) {
  if (is_in_spare_parentheses(list)) return expression(list.elements().front());
  const Deeper level(*this);
  A3D_TRY(level.check(place_));
  if (list.is_symbol()) return symbol(list.as_symbol());
  if (!list.is_list()) return make(Literal{list});
  return list_expression(list);
}

// NOLINTNEXTLINE(misc-no-recursion)
Result<ExpressionPtr> NestedReader::list_expression(const NestedList& list) {
  const List& items = list.elements();
  if (items.empty()) return error("an expression", list);
  const NestedList& head = items.front();
  if (head.is_symbol()) {
    if (is_symbol(head, "fun")) return function(items);
    if (is_symbol(head, "const") && items.size() == 4 && is_symbol(items[2], "value"))
      return constant(items[1], items[3]);
    if (const Operator* op = registry_.find_operator(head.as_symbol()); op != nullptr) return application(*op, items);
  }
  if (items.size() == 2 && is_type_head(head)) return constant(head, items[1]);
  if (head.is_symbol()) return function_call(items);
  return error("an operator, a function or a type as the first element of a list", list);
}

Result<ExpressionPtr> NestedReader::symbol(const std::string& name) {
  if (const int parameter = implicit_parameter(name); parameter > 0) return make(ParameterUse{parameter});
  if (algebra3d::is_file_atom(name)) return make(file_literal(NestedList::symbol(name), place_));
  if (is_fraction(name)) return no_operand(name);
  const bool is_bound = std::ranges::find(bound_, name) != bound_.end();
  if (!is_bound && is_reserved(name)) return Error(ErrorCode::syntax_error, "{}", no_operand_text(name)).at(place_);
  return make(NameUse{name});
}

// `N/1` may be how an integer beyond 64 bits is read (expression_list.h).
Error NestedReader::no_operand(const std::string& fraction) const {
  const std::string integer = fraction.substr(0, fraction.find('/'));
  const bool is_integer = fraction.ends_with("/1") && !algebra3d::parse_int(integer);
  return Error(ErrorCode::syntax_error, "{}",
               is_integer ? int_range_text(integer)
                          : "the fraction " + fraction + " may only stand for a coordinate of a constant")
      .at(place_);
}

int NestedReader::implicit_parameter(std::string_view name) const {
  if (std::ranges::find(bound_, name) != bound_.end()) return 0;
  if (name == "tuple" || name == "group") return 1;
  if (name.size() != 6 || !name.starts_with("tuple")) return 0;
  const char digit = name.back();
  return digit >= '1' && digit <= '9' ? digit - '0' : 0;
}

bool NestedReader::is_type_head(const NestedList& head) const {
  if (head.is_list()) return !head.elements().empty() && !is_symbol(head.elements().front(), "fun");
  return head.is_symbol() && (registry_.find_type(head.as_symbol()) != nullptr || head.is_symbol("longint"));
}

Result<ExpressionPtr> NestedReader::constant(const NestedList& type_list, const NestedList& value) {
  TypedLiteral literal;
  A3D_ASSIGN(literal.type, type(type_list));
  literal.list = value;
  algebra3d::read_large_integers_as_reals(literal.list);
  return make(std::move(literal));
}

// NOLINTNEXTLINE(misc-no-recursion)
Result<ExpressionPtr> NestedReader::application(const Operator& op, const List& items) {
  const bool is_attribute_use = op.name == "attr" && items.size() == 3 && items[1].is_symbol() && items[2].is_symbol();
  if (is_attribute_use)
    if (const int parameter = implicit_parameter(items[1].as_symbol()); parameter > 0)
      return make(AttributeUse{parameter, items[2].as_symbol()});
  const SyntaxPattern& pattern = registry_.syntax(op);
  Application result{op.name, {}, true};
  for (std::size_t index = 0; index + 1 < items.size(); ++index) {
    const std::size_t bracket = index - pattern.operand_count;
    const bool is_declared = index >= pattern.operand_count && bracket < pattern.places.size();
    const Place place = is_declared ? pattern.places[bracket] : Place{};
    const bool is_bracket_value =
        index >= pattern.operand_count && pattern.has_brackets && place.kind == PlaceKind::value;
    const NestedList& item = is_bracket_value ? in_brackets(items[index + 1]) : items[index + 1];
    A3D_ASSIGN(Argument next, argument(op.name, place, item));
    result.arguments.push_back(std::move(next));
  }
  return make(std::move(result));
}

// `(translate v (vec))`: a list of one element in the brackets is that element, unless it is a call without arguments.
const NestedList& NestedReader::in_brackets(const NestedList& item) const {
  if (!item.is_list() || item.elements().size() != 1) return item;
  const NestedList& only = item.elements().front();
  return only.is_symbol() && registry_.find_operator(only.as_symbol()) != nullptr ? item : only;
}

// NOLINTNEXTLINE(misc-no-recursion)
Result<Argument> NestedReader::argument(const std::string& op, const Place& place, const NestedList& item) {
  Argument argument;
  argument.kind = place.kind;
  argument.place = place_;
  if (place.kind == PlaceKind::value || place.kind == PlaceKind::function) {
    A3D_ASSIGN(argument.value, expression(item));
    return argument;
  }
  // Lists of functions hold expressions, which would be read twice on every level.
  if (place.kind == PlaceKind::functions && has_form_of_functions(item)) {
    A3D_TRY(functions(op, item, argument));
    return argument;
  }
  Status read = names_at(op, item, argument);
  auto operand = expression(item);
  if (!read && !operand) return std::move(read).error();
  if (!read) argument.misread = std::move(read).error();
  if (operand) argument.as_operand = std::move(operand).value();
  return argument;
}

Status NestedReader::names_at(const std::string& op, const NestedList& item, Argument& argument) {
  switch (argument.kind) {
    case PlaceKind::attributes:
      return names(op, item, argument);
    case PlaceKind::keys:
    case PlaceKind::renames:
      return pairs(op, item, argument);
    case PlaceKind::functions:
      return error(op + ": a list of (name function)", item);
    default:
      argument.names = {name_in(item)};
      return argument.names.front().empty() ? Status(error(op + ": a name", item)) : Status();
  }
}

// `(A B)`
Status NestedReader::names(const std::string& op, const NestedList& item, Argument& argument) const {
  if (!item.is_list()) return error(op + ": a list of attribute names", item);
  for (const NestedList& element : item.elements()) {
    argument.names.push_back(name_in(element));
    if (argument.names.back().empty()) return error(op + ": an attribute name", element);
  }
  return {};
}

// `((A asc) B)` for keys, `((New Old))` for renames.
Status NestedReader::pairs(const std::string& op, const NestedList& item, Argument& argument) const {
  const bool are_keys = argument.kind == PlaceKind::keys;
  const std::string expected = op + (are_keys ? ": an attribute name or (name asc|desc)" : ": (new old)");
  if (!item.is_list()) return error(op + ": a list", item);
  for (const NestedList& element : item.elements()) {
    const bool is_plain = are_keys && !name_in(element).empty();
    if (!is_plain && !is_pair(element)) return error(expected, element);
    argument.names.push_back(name_in(is_plain ? element : element.elements()[0]));
    argument.modifiers.push_back(is_plain ? "asc" : name_in(element.elements()[1]));
    const std::string& modifier = argument.modifiers.back();
    const bool is_order = modifier == "asc" || modifier == "desc";
    if (argument.names.back().empty() || modifier.empty() || (are_keys && !is_order)) return error(expected, element);
  }
  return {};
}

// `((Name e) ...)`
// NOLINTNEXTLINE(misc-no-recursion)
Status NestedReader::functions(const std::string& op, const NestedList& item, Argument& argument) {
  for (const NestedList& element : item.elements()) {
    if (name_in(element.elements()[0]).empty()) return error(op + ": (name function)", element);
    NamedExpression function{name_in(element.elements()[0]), nullptr};
    A3D_ASSIGN(function.value, expression(element.elements()[1]));
    argument.functions.push_back(std::move(function));
  }
  return {};
}

// `(fun (p T) ... body)`
// NOLINTNEXTLINE(misc-no-recursion)
Result<ExpressionPtr> NestedReader::function(const List& items) {
  if (items.size() < 2) return error("(fun (parameter type) ... body)", NestedList(items));
  FunctionLiteral result;
  const std::size_t bound_before = bound_.size();
  for (std::size_t index = 1; index + 1 < items.size(); ++index) {
    if (!is_pair(items[index]) || !is_identifier(symbol_in(items[index].elements()[0])))
      return error("(parameter type)", items[index]);
    A3D_ASSIGN(TypeSyntax parameter_type, type(items[index].elements()[1]));
    bound_.push_back(items[index].elements()[0].as_symbol());
    result.parameters.push_back({bound_.back(), std::move(parameter_type)});
  }
  A3D_ASSIGN(result.body, expression(items.back()));
  bound_.resize(bound_before);
  return make(std::move(result));
}

// NOLINTNEXTLINE(misc-no-recursion)
Result<ExpressionPtr> NestedReader::function_call(const List& items) {
  FunctionCall call{items.front().as_symbol(), {}};
  for (std::size_t index = 1; index < items.size(); ++index) {
    A3D_ASSIGN(ExpressionPtr argument, expression(items[index]));
    call.arguments.push_back(std::move(argument));
  }
  return make(std::move(call));
}

// NOLINTNEXTLINE(misc-no-recursion)
Result<TypeSyntax> NestedReader::type(const NestedList& list) {
  TypeSyntax syntax;
  syntax.place = place_;
  if (list.is_symbol()) {
    syntax.name = list.as_symbol();
    return syntax;
  }
  if (!list.is_list() || list.elements().empty() || !list.elements().front().is_symbol()) return error("a type", list);
  const List& items = list.elements();
  syntax.name = items.front().as_symbol();
  if (syntax.name == "typeOf" && items.size() == 2) {
    syntax.name.clear();
    A3D_ASSIGN(syntax.type_of, expression(items[1]));
    return syntax;
  }
  if (syntax.name == "tuple") {
    if (items.size() != 2 || !items[1].is_list()) return error("(tuple ((Name type) ...))", list);
    for (const NestedList& element : items[1].elements()) {
      if (!is_pair(element) || !is_identifier(symbol_in(element.elements()[0]))) return error("(Name type)", element);
      A3D_ASSIGN(TypeSyntax attribute, type(element.elements()[1]));
      syntax.attributes.push_back({element.elements()[0].as_symbol(), std::move(attribute)});
    }
    return syntax;
  }
  for (std::size_t index = 1; index < items.size(); ++index) {
    A3D_ASSIGN(TypeSyntax argument, type(items[index]));
    syntax.arguments.push_back(std::move(argument));
  }
  return syntax;
}

}  // namespace queries
