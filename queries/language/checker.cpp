#include "queries/language/checker.h"

#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"
#include "queries/language/constant_folding.h"
#include "queries/language/estimates.h"
#include "queries/language/rewriting.h"
#include "queries/streams/value_operators.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Operator;
using algebra3d::SyntaxPattern;
using PlaceKind = SyntaxPattern::PlaceKind;

bool is_literal(const Expression& expression) {
  return std::holds_alternative<Literal>(expression.node) || std::holds_alternative<TypedLiteral>(expression.node) ||
         std::holds_alternative<HostValue>(expression.node);
}

std::optional<std::int64_t> int_literal(const Expression& expression) {
  const auto* literal = std::get_if<Literal>(&expression.node);
  if (literal == nullptr || !literal->atom.is_int()) return std::nullopt;
  return literal->atom.as_int();
}

}  // namespace

Result<TypedPtr> Checker::check(const Expression& expression) {
  return std::visit([&](const auto& node) { return check(node, expression.place); }, expression.node);
}

Result<TypedPtr> Checker::check_result(const Expression& expression) {
  A3D_ASSIGN(TypedPtr node, check(expression));
  if (!node->gives_one_tuple()) return node;
  const Operator& consume = *registry_.find_operator("consume");
  ArgumentType argument;
  argument.type = node->type();
  A3D_ASSIGN(BoundOperator bound, bind_operator(registry_, consume, {&argument, 1}, context_));
  return make_stream_call(consume, std::move(bound), {std::move(node)}, expression.place);
}

Result<TypedPtr> Checker::check(const Literal& literal, const SourcePlace& place) {
  const NestedList& atom = literal.atom;
  const std::string_view type = atom.is_int()      ? "int"
                                : atom.is_real()   ? "real"
                                : atom.is_bool()   ? "bool"
                                : atom.is_string() ? "string"
                                                   : "text";
  TypedLiteral typed;
  typed.list = atom;
  return constant(TypeExpr(type), typed, place);
}

Result<TypedPtr> Checker::check(const TypedLiteral& literal, const SourcePlace& place) {
  A3D_ASSIGN(const TypeExpr type, resolve(literal.type));
  return constant(type, literal, place);
}

Result<TypedPtr> Checker::check(const HostValue& given, const SourcePlace& place) {
  TypeExpr type = given.value.type().term();
  if (!given.value.is_defined() && !given.reason.empty())
    return make_undefined(std::move(type), given.value, given.reason, place);
  return make_constant(std::move(type), Datum{given.value}, place);
}

Result<TypedPtr> Checker::check(const Application& application, const SourcePlace& place) {
  const Operator& op = *registry_.find_operator(application.name);
  std::vector<TypeExpr> types;
  if (recorder_ == nullptr) return application_node(op, application, place, types);
  const std::size_t step = recorder_->begin(op.name);
  A3D_ASSIGN(TypedPtr node, application_node(op, application, place, types));
  const auto estimate =
      recorder_->without_counting([&] { return estimated_tuples(*node, objects_, context_, !scopes_.empty()); });
  recorder_->describe(step, node->how(), estimate);
  std::string signature = algebra3d::argument_list_text(types) + " -> " + node->type().text();
  return recorder_->finish(step, std::move(signature), std::move(node));
}

Result<TypedPtr> Checker::application_node(const Operator& op, const Application& application, const SourcePlace& place,
                                           std::vector<TypeExpr>& types) {
  std::vector<TypedPtr> checked(application.arguments.size());
  if (application.is_call) {
    A3D_ASSIGN(TypedPtr call, call_of_function(application, place, checked));
    if (call != nullptr) return call;
  }
  return takes_streams(op) ? stream_application(op, application, checked, place, types)
                           : value_application(op, application, std::move(checked), place, types);
}

// `checked` holds the operands that are checked already.
Result<TypedPtr> Checker::value_application(const Operator& op, const Application& application,
                                            std::vector<TypedPtr> checked, const SourcePlace& place,
                                            std::vector<TypeExpr>& types) {
  for (std::size_t index = 0; index < checked.size(); ++index) {
    if (checked[index] == nullptr) {
      A3D_ASSIGN(checked[index], check(*application.arguments[index].value));
    }
    types.push_back(checked[index]->type());
  }
  auto call = registry_.resolve(op, types);
  if (!call) return std::move(call).error().at(place);
  TypedPtr node = make_value_call(*call, std::move(checked), place);
  return objects_.rewrites_plans() ? folded(std::move(node), context_) : node;
}

Status Checker::check_place_count(const Operator& op, const Application& application, const SourcePlace& place) {
  const SyntaxPattern& pattern = registry_.syntax(op);
  const std::size_t given = application.arguments.size();
  if (given >= pattern.place_count() && (given == pattern.place_count() || pattern.is_open_ended)) return {};
  // The operand before the operator is always there in a text.
  const std::size_t before = pattern.has_brackets && given >= pattern.operand_count ? pattern.operand_count : 0;
  if (before > 0 && given == before)
    return Error(ErrorCode::type_error, "{}: expected something in the brackets (syntax: {})", op.name, op.syntax)
        .at(place);
  const std::size_t expected = pattern.place_count() - before;
  return Error(ErrorCode::type_error, "{}: expected {}{} argument{}{}, got {} (syntax: {})", op.name,
               pattern.is_open_ended ? "at least " : "", expected, expected == 1 ? "" : "s",
               before > 0 ? " in the brackets" : "", given - before, op.syntax)
      .at(place);
}

Result<TypedPtr> Checker::stream_application(const Operator& op, const Application& application,
                                             const std::vector<TypedPtr>& checked, const SourcePlace& place,
                                             std::vector<TypeExpr>& shown_types) {
  A3D_TRY(check_place_count(op, application, place));
  const SyntaxPattern& pattern = registry_.syntax(op);
  static const std::vector<std::string> none;
  std::vector<TypedPtr> nodes;
  std::vector<ArgumentType> types;
  std::vector<TypeExpr> operands;
  for (std::size_t index = 0; index < application.arguments.size(); ++index) {
    const bool is_operand = index < pattern.operand_count;
    const std::size_t bracket = index - pattern.operand_count;
    const bool is_declared = !is_operand && bracket < pattern.places.size();
    const FunctionPlace functions{is_declared ? pattern.places[bracket].parameters : none, operands};
    ArgumentType type;
    auto node = checked_argument(application.arguments[index], checked[index], functions, type);
    if (!node) {
      Error error = std::move(node).error();
      if (!error.place.is_known()) error = std::move(error).about(op.name);
      return std::move(error).at(place);
    }
    if (is_operand) operands.push_back(type.type);
    // In prefix form the first arguments are the operands of later function places.
    if (pattern.operand_count == 0 && application.arguments[index].kind == PlaceKind::value)
      operands.push_back(type.type);
    if (!type.type.name().empty()) shown_types.push_back(type.type);
    nodes.push_back(std::move(node).value());
    types.push_back(std::move(type));
  }
  auto bound = bind_operator(registry_, op, types, context_);
  if (!bound) return std::move(bound).error().at(place);
  if (const auto* attribute = std::get_if<ReadsAttribute>(&bound->role))
    return make_attribute(bound->type, std::move(nodes[0]), attribute->index, place);
  if (objects_.rewrites_plans()) {
    const auto rewritten = [&] {
      return rewrite(op, *bound, nodes, {registry_, objects_, context_, recorder_ != nullptr, !scopes_.empty()});
    };
    A3D_TRY(recorder_ == nullptr ? rewritten() : recorder_->without_counting(rewritten));
  }
  return make_stream_call(op, std::move(bound).value(), std::move(nodes), place);
}

Result<TypedPtr> Checker::checked_argument(const Argument& argument, const TypedPtr& checked,
                                           const FunctionPlace& function_place, ArgumentType& type) {
  if (argument.misread) return *argument.misread;
  type.names = argument.names;
  type.modifiers = argument.modifiers;
  switch (argument.kind) {
    case PlaceKind::value: {
      TypedPtr node = checked;
      if (node == nullptr) {
        A3D_ASSIGN(node, check(*argument.value));
      }
      type.type = node->type();
      type.literal = int_literal(*argument.value);
      // Outside of all functions nothing depends on a parameter.
      if (scopes_.empty() || is_literal(*argument.value))
        type.constant = [node, &context = context_] {
          Context checking = context;
          if (checking.unchanging.empty()) checking.unchanging = "a command is being checked";
          return node->evaluate_value(nullptr, checking);
        };
      return node;
    }
    case PlaceKind::function: {
      A3D_ASSIGN(TypedPtr node, function_argument(*argument.value, function_place));
      type.type = node->type();
      return node;
    }
    case PlaceKind::functions: {
      std::vector<TypedPtr> functions;
      for (const auto& [name, value] : argument.functions) {
        A3D_ASSIGN(TypedPtr node, function_argument(*value, function_place));
        type.names.push_back(name);
        type.types.push_back(node->type());
        functions.push_back(std::move(node));
      }
      return make_list(std::move(functions), argument.place);
    }
    default:
      return make_list({}, argument.place);
  }
}

// No operator takes lists as values; a list of one element is that element, as in `(translate v (vec))`.
Result<TypedPtr> Checker::check(const ListExpression& list, const SourcePlace& place) {
  if (list.items.size() == 1 && list.items[0].name.empty() && list.items[0].modifier == nullptr)
    return check(*list.items[0].value);
  return Error(ErrorCode::type_error, "a list of {} elements is not a value", list.items.size()).at(place);
}

}  // namespace queries
